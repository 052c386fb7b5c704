#include <fmt/core.h>

#include <algorithm>

#include "commands.h"
#include "input.h"
#include "memory_watch.h"
#include "output.h"
#include "page_output.h"
#include "printable.h"
#include "progress_line.h"

namespace regionmesh::cli {
namespace {

void print_volumes(const PreserveReport& preserved) {
    if (preserved.rounds == 0) return;
    fmt::print("largest relative error of a region's volume {:.1e}; before the correction {:.1e}\n", preserved.drift,
               preserved.drift_before);
    if (preserved.regions_off > 0)
        fmt::print("{} regions have a volume error above {:.0e}\n", preserved.regions_off, kVolumeTolerance);
}

/// The faces that topology or --max-error leave are not known before the work.
void print_memory(const ReconstructOptions& options, std::uint64_t peak_bytes) {
    if (options.face_budget || peak_bytes <= options.memory + options.memory / 10) return;
    fmt::print("used more than --memory: the faces left by topology or --max-error are not known before the work\n");
}

void print_summary(const Settings& settings, const Report& report) {
    const CheckReport& check = report.check;
    const double seconds = std::max(report.seconds.at("total"), 1e-9);
    fmt::print("{}: {} faces, {} vertices (from {} faces)\n", printable(settings.output), report.final_faces,
               report.final_vertices, report.initial_faces);
    fmt::print(
        "quality: lowest {:.3f}, mean {:.3f}; {} regions, {} pairs with an interface, {} quadruple points inside\n",
        check.quality.min, check.quality.mean, check.regions.size(), check.region_pairs, check.quadruple_points_inside);
    print_improved(report);
    print_stop(settings, report);
    if (report.pinned_vertices > 0)
        fmt::print("{} vertices not moved: the mesh touches itself there, or more than four regions meet\n",
                   report.pinned_vertices);
    print_volumes(report.preserved);
    fmt::print("{:.2f} s, {:.0f} k faces/s, peak memory {} MB\n", report.seconds.at("total"),
               static_cast<double>(report.initial_faces) / 1e3 / seconds, report.peak_bytes / 1000000);
    print_memory(settings.reconstruct, report.peak_bytes);
    print_violations(check, 0);
    if (report.samples_in_room > 0)
        fmt::print("{} samples changed their label within --room\n", report.samples_in_room);
    print_certificate(check, report.samples ? &*report.samples : nullptr);
}

/// Reconstructs the input, whichever kind it is of, and sets `names` to those of its labels.
Reconstruction reconstruct_input(const Settings& settings, LabelNames& names) {
    ProgressLine line(settings.quiet);
    return with_reader(settings, settings.inputs, [&](auto& reader) {
        names = names_or(settings, reader.info().names);
        Reconstruction made =
            reconstruct(reader, settings.reconstruct, [&](const Progress& progress) { line.show(progress); });
        line.clear();
        return made;
    });
}

}  // namespace

int run_reconstruct(const Settings& settings) {
    require_outputs(settings);
    std::optional<MemoryWatch> watch;
    if (settings.memory_is_hard) watch.emplace(settings.reconstruct.memory);
    LabelNames names;
    Reconstruction made = reconstruct_input(settings, names);
    Report& report = made.report;
    const Model model{made.mesh, made.labels, made.background, names};
    OutputFiles files(settings.writing);
    double writing = 0;
    {
        const Timer timer(writing);
        write_model(settings, model, files);
    }
    report.seconds["write"] = writing;
    report.seconds["total"] += writing;
    write_report_file(settings, report, model, files);
    if (!settings.html.empty())
        write_page(settings.html, {page_model(settings.output, made.mesh, made.labels, made.background, names)},
                   page_options(kReconstruct, settings, report_json(report, made.labels, names), true), files);
    files.commit();
    settings.quiet ? print_stop(settings, report) : print_summary(settings, report);
    return exit_code(report);
}

}  // namespace regionmesh::cli
