#include "output.h"

#include <fmt/core.h>

#include <cstdio>

#include "advice.h"
#include "commands.h"
#include "messages.h"
#include "page_output.h"
#include "printable.h"

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
    require_writable_mesh(
        settings.output,
        {.per_region = settings.per_region, .boundary_is_open = !settings.reconstruct.cap, .output = settings.writing});
    require_tables(settings);
}

void require_tables(const Settings& settings) {
    if (!settings.names.empty()) read_label_names(settings.names);
    for (const std::string& file : {settings.report, settings.regions, settings.interfaces, settings.lines})
        if (!file.empty()) require_writable(file, settings.writing);
    require_page(settings.html, settings.writing);
}

Described describe(const Settings& settings, const LabelNames& names, const LabelColours& colours) {
    if (settings.names.empty()) return {names, colours};
    Described described{read_label_names(settings.names), read_label_colours(settings.names)};
    if (described.colours.empty()) described.colours = colours;
    return described;
}

void write_tables(const Settings& settings, const Model& model, OutputFiles& files) {
    for (const auto& [path, make] :
         {std::pair(&settings.regions, &regions_csv), std::pair(&settings.interfaces, &interfaces_csv),
          std::pair(&settings.lines, &lines_csv)})
        if (!path->empty()) files.add(*path).write(make(model.mesh, model.labels, model.background, model.names));
}

OutputOptions model_writing(const Settings& settings) {
    OutputOptions options = settings.writing;
    options.threads = settings.reconstruct.threads;
    return options;
}

void warn_of_rounding(const std::string& output, double share_of_edge, const std::string& advice) {
    constexpr double kMostRounded = 0.01;
    if (share_of_edge > kMostRounded)
        warn(
            fmt::format("{}: its numbers of single precision move points by up to {:.2g} of an edge, so far from the "
                        "origin: faces may degenerate or cross; {}, or move the origin",
                        output, share_of_edge, advice));
}

std::vector<std::filesystem::path> write_model(const Settings& settings, const Model& model, OutputFiles& files) {
    write_tables(settings, model, files);
    const WriteOptions options{.background = model.background,
                               .names = model.names,
                               .colours = model.colours,
                               .per_region = settings.per_region,
                               .coordinates = model.coordinates};
    if (settings.ascii) {
        if (settings.per_region)
            throw Error(ErrorCode::kUsage,
                        "--ascii and --per-region: a file of one region is binary; give one of them");
        write_ascii_stl(model.mesh, model.labels, settings.output, options, files);
        return {settings.output};
    }
    warn_of_rounding(settings.output, rounded_share_of_edge(model.mesh, settings.output, options),
                     "write .vtp or .ply");
    return write_mesh(model.mesh, model.labels, settings.output, options, files);
}

std::string output_text(const Settings& settings) {
    return printable(settings.output) + (settings.per_region ? " (one file a region)" : "");
}

void print_region_files(const Settings& settings, const std::vector<std::filesystem::path>& written) {
    if (!settings.per_region) return;
    for (const auto& file : written) say("{}", printable(file.string()));
}

std::string report_text(const Report& report, const Model& model, const MadeBy& made_by) {
    return report_json(report, model.labels, model.names, made_by, model.coordinates.metres);
}

void write_report_file(const Settings& settings, Report& report, const Model& model, const MadeBy& made_by,
                       OutputFiles& files) {
    report.peak_bytes = peak_resident_bytes();
    if (!settings.report.empty()) files.add(settings.report).write(report_text(report, model, made_by));
}

int exit_code(const CheckReport& report) { return report.violation_count() == 0 ? kGood : kViolations; }

int exit_code(const Report& report) {
    const int code = exit_code(report.check);
    return code == kGood && report.preserved.regions_off > 0 ? kNotMet : code;
}

std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

std::string plural_of(const std::string& noun) {
    if (noun == "tetrahedron") return "tetrahedra";
    return noun == "vertex" ? "vertices" : noun + 's';
}

std::string counted(std::uint64_t count, const std::string& noun) {
    return grouped(count) + ' ' + (count == 1 ? noun : plural_of(noun));
}

void print_remeshed(const Report& report) {
    if (!report.remeshed) return;
    const EdgeLengths &before = report.remeshed->before, &after = report.remeshed->after;
    say("edges: {:.1f} % -> {:.1f} % from {} to {} of --edge-length, mean {:.3g} -> {:.3g}", 100 * before.share(),
        100 * after.share(), kLeastOfLength, kMostOfLength, before.mean, after.mean);
}

void print_smoothed_lines(const Report& report) {
    if (!report.smoothed_lines) return;
    say("lines: mean angle between edges {:.1f} -> {:.1f} degrees", report.smoothed_lines->turn_before,
        report.smoothed_lines->turn_after);
}

void print_floor(const Report& report) {
    if (!report.floor || report.floor->below_before == 0) return;
    say("shape: {} below quality {:.3g} -> {}, lowest {:.3f} -> {:.3f}", counted(report.floor->below_before, "face"),
        report.quality_bound.value_or(0), grouped(report.floor->below_after), report.floor->lowest_before,
        report.floor->lowest_after);
}

void print_improved(const Report& report) {
    if (!report.improved) return;
    const FaceShapes &before = report.improved->before, &after = report.improved->after;
    say("improved: lowest quality {:.3f} -> {:.3f}, mean {:.3f} -> {:.3f}, angles {:.1f} to {:.1f} -> {:.1f} to {:.1f} "
        "degrees, {} -> {} faces below --min-quality",
        before.min_quality, after.min_quality, before.mean_quality, after.mean_quality, before.min_angle,
        before.max_angle, after.min_angle, after.max_angle, before.faces_below, after.faces_below);
}

void print_violations(const CheckReport& report, int listed) {
    for (int kind = 0; kind < kViolationKindCount; ++kind) {
        if (!report.counts[kind]) continue;
        say("violation {}: {}", to_string(static_cast<ViolationKind>(kind)), report.counts[kind]);
        int count = 0;
        for (const Violation& violation : report.violations)
            if (violation.kind == static_cast<ViolationKind>(kind) && count++ < listed) say("  {}", violation.text);
        if (listed > 0 && report.counts[kind] > static_cast<std::uint64_t>(listed))
            say("  and {} more; --json lists them", grouped(report.counts[kind] - listed));
    }
}

std::string samples_text(const SampleAgreement& samples, bool has_room) {
    if (samples.wrong == 0)
        return fmt::format("every one of {} samples keeps its label{}", grouped(samples.samples),
                           has_room ? ", or the one that --room gave it" : "");
    return fmt::format("{} of {} samples lie in another region, Dice {:.6f}", grouped(samples.wrong),
                       grouped(samples.samples), samples.dice());
}

std::string promise_text(const DenoiseReport& done, const std::optional<double>& metres) {
    const double kept = 1 - static_cast<double>(done.changed + done.speck_samples) / static_cast<double>(done.samples);
    std::string text = fmt::format("{:.{}f} % of {} samples keep their label", 100 * kept, kept > 0.9999 ? 4 : 2,
                                   grouped(done.samples));
    if (done.changed > 0)
        text += fmt::format("; {} others, none deeper than {:.3g}{}, were stray", grouped(done.changed),
                            done.largest_distance, metres ? ' ' + length_symbol(*metres) : "");
    if (done.specks > 0)
        text += fmt::format("; {} of at most {} joined their neighbours", counted(done.specks, "speck"),
                            counted(done.largest_speck, "sample"));
    text += fmt::format("; {} of {} labels, topology as in the labels", done.labels_left, done.labels);
    if (done.specks > 0) text += " without specks";
    if (done.cut_samples > 0) text += fmt::format(" and {} threads and pinholes", grouped(done.cut_samples));
    return text;
}

void print_denoised(const DenoiseReport& done) {
    if (done.roughness || !done.refused.empty()) say("{}", done.text());
}

void print_certificate(const Report& run, const std::optional<double>& metres) {
    const CheckReport& report = run.check;
    std::string text = report.violation_count() == 0 ? "no violations" : counts_text(report);
    const bool is_kept = run.samples && run.samples->wrong == 0;
    if (is_kept && run.denoise.has_changes())
        text += "; " + promise_text(run.denoise, metres);
    else if (run.samples)
        text += "; " + samples_text(*run.samples, run.samples_in_room > 0);
    say("checked: {}", text);
}

void print_stop(const Settings& settings, const Report& report) {
    const char* reason = nullptr;
    if (report.stopped == StopReason::kTopology)
        reason = settings.inputs.empty() || !is_lattice(settings, settings.inputs)
                     ? "every further collapse would change topology, or fold, cross or degrade faces"
                     : "every further collapse would change topology, fold, cross or degrade faces, "
                       "or carry samples into other regions";
    if (report.stopped == StopReason::kMaxError) reason = "every further collapse would exceed --max-error";
    const ReconstructOptions& asked = settings.reconstruct;
    const bool is_missed = asked.target_faces || asked.reduce;
    if (!reason && !settings.quiet && !settings.inputs.empty() && has_free_target(settings) &&
        is_lattice(settings, settings.inputs))
        say("no target was given: faces that cost nothing are gone, and no point is off by more than {:.3g}; --reduce "
            "90% "
            "removes more, --no-decimate keeps all",
            report.error_bound);
    if (!reason || (settings.quiet && !is_missed)) return;
    const std::string line = fmt::format("{}: {}", is_missed ? "stopped before the target" : "stopped", reason);
    // A message that nobody can read is no reason to fail.
    if (settings.quiet) std::fputs(("regionmesh: " + line + "\n").c_str(), stderr);
    say("{}", line);
    if (is_missed && report.stopped == StopReason::kTopology) say("{}", missed_text(settings, report.verdicts));
}

void print_orient_hint(const CheckReport& report) {
    if (report.counts[static_cast<int>(ViolationKind::kOrientation)] > 0)
        say("faces with opposite orientations: --orient turns them");
}

void print_locked_part(const ModelChange& change) {
    const CheckReport &before = change.before, &after = change.report.check;
    if (before.violation_count() > 0)
        say("{} vertices and {} faces not changed, because of violations in the input: {}", change.locked.vertices,
            change.locked.faces, counts_text(before));
    print_orient_hint(before);
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (after.counts[kind] > before.counts[kind])
            say("more violations than in the input: {} {}, before {}", to_string(static_cast<ViolationKind>(kind)),
                after.counts[kind], before.counts[kind]);
}

}  // namespace regionmesh::cli
