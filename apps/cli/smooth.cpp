#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"
#include "printable.h"

namespace regionmesh::cli {
namespace {

WantedVolumes volumes_of(const CheckReport& report) {
    WantedVolumes volumes;
    for (const RegionReport& region : report.regions) {
        if (region.label >= volumes.size()) volumes.resize(region.label + 1);
        volumes[region.label] = region.volume;
    }
    return volumes;
}

/// Smooths, and reports it as reconstruct does. `before` is the check of the mesh in these axes.
Report smoothed(const Settings& settings, Mesh& mesh, const BoxAxes& axes, const CheckReport& before) {
    Report report;
    report.initial_faces = report.final_faces = mesh.face_count();
    report.initial_vertices = report.final_vertices = mesh.vertex_count();
    report.stopped = "none asked";
    {
        const Timer timer(report.seconds["smooth"]);
        report.smoothing = smooth(mesh, smooth_options(settings, mesh));
    }
    report.smoothing.scale_volumes(axes.volume_factor());
    report.unsmoothed_volumes = report.smoothing.volume_before;
    if (settings.reconstruct.preserve_volume) {
        const Timer timer(report.seconds["preserve volume"]);
        report.preserved = preserve_volumes(mesh, volumes_of(before), smooth_options(settings, mesh));
    }
    return report;
}

void print_summary(const std::string& path, const Report& report, const CheckReport& before) {
    say("{}: {} vertices, {} of them backtracked; largest displacement {:.3g}; lowest quality {:.3f}; {} violations "
        "(before {})",
        printable(path), report.smoothing.vertices, report.smoothing.backtracked, report.smoothing.largest_displacement,
        report.check.quality.min, report.check.violation_count(), before.violation_count());
}

}  // namespace

int run_smooth(const Settings& given) {
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    const BoxAxes axes(file.mesh);
    const CheckReport before = check(file.mesh, options);
    const LockedPart fixed = before.violation_count() > 0 ? lock_violations(file.mesh, options) : LockedPart{};
    if (!settings.reconstruct.cap) fix_rims(file.mesh);
    Report report = smoothed(settings, file.mesh, axes, before);
    axes.restore(file.mesh);
    report.check = check(file.mesh, options);
    const auto [names, colours] = describe(settings, file.names, file.colours);
    const Model model{file.mesh, file.labels, options.background, names, colours, file.space};
    OutputFiles files(model_writing(settings));
    const auto written = write_model(settings, model, files);
    write_report_file(settings, report, model, made_by(kSmooth, settings), files);
    files.commit();
    print_region_files(settings, written);
    print_summary(settings.output, report, before);
    print_fixed_part(fixed, before, report.check);
    return exit_code(report);
}

}  // namespace regionmesh::cli
