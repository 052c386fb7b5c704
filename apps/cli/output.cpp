#include "output.h"

#include <fmt/core.h>

#include "commands.h"

namespace regionmesh::cli {
namespace {

/// "pinched_vertex 12, open_edge 40": all kinds found, in their order.
std::string counts_text(const CheckReport& report) {
    std::string text;
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (report.counts[kind] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(static_cast<ViolationKind>(kind)),
                                report.counts[kind]);
    return text;
}

}  // namespace

void require_outputs(const Settings& settings) {
    require_writable_mesh(settings.output,
                          {.per_region = settings.per_region, .boundary_is_open = !settings.reconstruct.cap});
    if (!settings.names.empty()) read_label_names(settings.names);
    if (!settings.report.empty()) require_writable(settings.report);
    if (!settings.regions.empty()) require_writable(settings.regions);
}

LabelNames names_or(const Settings& settings, const LabelNames& found) {
    return settings.names.empty() ? found : read_label_names(settings.names);
}

void write_model(const Settings& settings, const Mesh& mesh, const LabelTable& labels,
                 const std::vector<Label>& background, const ModelNotes& notes) {
    const auto written = write_mesh(mesh, labels, settings.output,
                                    {.background = background,
                                     .names = notes.names,
                                     .per_region = settings.per_region,
                                     .space = notes.space,
                                     .metres = settings.metres});
    if (!settings.regions.empty()) write_text(settings.regions, regions_csv(mesh, labels, background, notes.names));
    if (settings.quiet || !settings.per_region) return;
    for (const auto& file : written) fmt::print("{}\n", file.string());
}

void write_report_file(const Settings& settings, Report& report, const LabelTable& labels, const LabelNames& names) {
    report.peak_bytes = peak_resident_bytes();
    if (!settings.report.empty()) write_text(settings.report, report_json(report, labels, names));
}

int exit_code(const CheckReport& report) { return report.violation_count() == 0 ? kGood : kViolations; }

/// 7109137 as 7,109,137.
std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

void print_violations(const CheckReport& report, int listed) {
    for (int kind = 0; kind < kViolationKindCount; ++kind) {
        if (!report.counts[kind]) continue;
        fmt::print("violation {}: {}\n", to_string(static_cast<ViolationKind>(kind)), report.counts[kind]);
        int count = 0;
        for (const Violation& violation : report.violations)
            if (violation.kind == static_cast<ViolationKind>(kind) && count++ < listed)
                fmt::print("  {}\n", violation.text);
    }
}

void print_certificate(const CheckReport& report, const SampleAgreement* samples) {
    std::string text = report.violation_count() == 0 ? "no violations" : counts_text(report);
    if (samples)
        text += samples->wrong == 0
                    ? fmt::format("; every one of {} samples keeps its label", grouped(samples->samples))
                    : fmt::format("; {} of {} samples lie in another region, Dice {:.6f}", grouped(samples->wrong),
                                  grouped(samples->samples), samples->dice());
    fmt::print("checked: {}\n", text);
}

void print_orient_hint(const CheckReport& report) {
    if (report.counts[static_cast<int>(ViolationKind::kOrientation)] > 0)
        fmt::print("faces with opposite orientations: --orient turns them\n");
}

void print_fixed_part(const LockedPart& fixed, const CheckReport& before, const CheckReport& after) {
    if (before.violation_count() > 0)
        fmt::print("{} vertices and {} faces not changed, because of violations in the input: {}\n", fixed.vertices,
                   fixed.faces, counts_text(before));
    print_orient_hint(before);
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (after.counts[kind] > before.counts[kind])
            fmt::print("more violations than in the input: {} {}, before {}\n",
                       to_string(static_cast<ViolationKind>(kind)), after.counts[kind], before.counts[kind]);
}

}  // namespace regionmesh::cli
