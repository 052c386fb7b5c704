#include "regionmesh/change_model.h"

#include <algorithm>

#include "regionmesh/box_axes.h"
#include "regionmesh/improve.h"
#include "regionmesh/process.h"
#include "regionmesh/remesh.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "regionmesh/smooth_lines.h"
#include "regionmesh/write_report.h"
#include "simplify/decimate.h"
#include "stream/run_promises.h"

namespace regionmesh {
namespace {

/// Checks the mesh, and locks what has violations.
ModelChange begin(Mesh& mesh, const CheckOptions& checks) {
    ModelChange change;
    change.before = check(mesh, checks);
    if (change.before.violation_count() > 0) change.locked = lock_violations(mesh, checks);
    change.report.initial_faces = change.report.peak_faces = mesh.face_count();
    change.report.initial_vertices = mesh.vertex_count();
    return change;
}

/// Unlocks the mesh and checks it again. So that ids in the report are the numbers of points and faces in a file, they
/// become dense.
void end(Mesh& mesh, const CheckOptions& checks, Report& report) {
    mesh.compact();
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) mesh[VertexId{v}].is_fixed = false;
    report.check = check(mesh, checks);
    report.final_faces = mesh.face_count();
    report.final_vertices = mesh.vertex_count();
    report.peak_bytes = peak_resident_bytes();
}

void note_simplified(const SimplifyResult& done, Report& report) {
    report.verdicts = done.verdicts;
    report.refreshes = done.refreshes;
    report.stopped = done.stopped;
    report.error_bound = done.error_bound;
    report.bytes_per_face =
        static_cast<double>(done.bytes) / static_cast<double>(std::max<std::uint64_t>(report.peak_faces, 1));
}

WantedVolumes volumes_of(const CheckReport& report) {
    WantedVolumes volumes;
    for (const RegionReport& region : report.regions) {
        if (region.label >= volumes.size()) volumes.resize(region.label + 1);
        volumes[region.label] = region.volume;
    }
    return volumes;
}

/// Axes of the samples, or of the box of the mesh where it is not theirs.
BoxAxes axes_of(Mesh& mesh, const std::optional<Lattice>& samples) {
    if (samples)
        if (BoxAxes axes(mesh, *samples); axes.samples()) return axes;
    return BoxAxes(mesh);
}

}  // namespace

ModelChange simplify_model(Mesh& mesh, const Settings& settings, const CheckOptions& checks,
                           const std::optional<Vec3>& spacing, const std::optional<Lattice>& samples,
                           const OnModelChange& on_change) {
    const auto note = [&](const char* stage, std::uint64_t gone, const std::optional<std::uint64_t>& in_all) {
        if (on_change) on_change(stage, gone, in_all);
    };
    const BoxAxes axes = axes_of(mesh, samples);
    ModelChange change = begin(mesh, checks);
    Report& report = change.report;
    Ground ground{.scale = typical_edge(mesh), .samples = axes.samples(), .spacing = spacing};
    if (!settings.reconstruct.cap) ground.box = size_of(mesh).box;
    const Promises promises = promises_of(settings.reconstruct, ground);
    SimplifyOptions options = simplify_options(settings.reconstruct, promises);
    options.target_faces = target_faces(settings, mesh);
    std::optional<std::uint64_t> in_all;  // known where the target is a number of faces
    if (options.target_faces > 0) in_all = report.initial_faces - options.target_faces;
    options.on_progress = [&](std::uint64_t left) { note("decimate", report.initial_faces - left, in_all); };
    if (settings.reconstruct.decimate) {
        const Timer timer(report.seconds["decimate"]);
        note_simplified(simplify(mesh, options), report);
        if (has_target(settings)) {
            report.quality_bound = promises.quality_bound();
            report.floor = raise_floor(mesh, promises);
            report.error_bound = trim_added(mesh, options, report.stopped, report.verdicts);
        }
    }
    if (settings.reconstruct.edge_length) {
        const Timer timer(report.seconds["remesh"]);
        RemeshOptions remeshing{.promises = promises, .edge_length = *settings.reconstruct.edge_length};
        remeshing.on_progress = [&] { note("remesh", 0, std::nullopt); };
        report.remeshed = remesh(mesh, remeshing);
        report.quality_bound = promises.quality_bound();
        const FloorResult floor = raise_floor(mesh, promises);
        if (report.floor)
            report.floor->follow(floor);
        else
            report.floor = floor;
        report.error_bound = floor.error_bound;
    }
    if (settings.reconstruct.smooth_lines) {
        const Timer timer(report.seconds["smooth lines"]);
        SmoothLinesOptions smoothing{.promises = promises, .threads = options.threads};
        smoothing.on_progress = [&] { note("smooth lines", 0, std::nullopt); };
        report.smoothed_lines = smooth_lines(mesh, smoothing);
        report.error_bound = report.smoothed_lines->error_bound;
    }
    if (settings.reconstruct.improve) {
        const Timer timer(report.seconds["improve"]);
        ImproveOptions improving{.promises = promises};
        improving.on_progress = [&] { note("improve", 0, std::nullopt); };
        report.improved = improve(mesh, improving);
        report.error_bound = report.improved->error_bound;
    }
    axes.restore(mesh);
    note("check", 0, std::nullopt);
    end(mesh, checks, report);
    return change;
}

ModelChange smooth_model(Mesh& mesh, const Settings& settings, const CheckOptions& checks) {
    const BoxAxes axes(mesh);
    ModelChange change = begin(mesh, checks);
    Report& report = change.report;
    if (checks.boundary_is_open) fix_rims(mesh);
    const SmoothOptions options = smooth_options(settings.reconstruct, settings.scale.value_or(typical_edge(mesh)));
    {
        const Timer timer(report.seconds["smooth"]);
        report.smoothing = smooth(mesh, options);
    }
    report.smoothing.scale_volumes(axes.volume_factor());
    report.unsmoothed_volumes = report.smoothing.volume_before;
    if (settings.reconstruct.preserve_volume) {
        const Timer timer(report.seconds["preserve volume"]);
        report.preserved = preserve_volumes(mesh, volumes_of(change.before), options);
    }
    axes.restore(mesh);
    end(mesh, checks, report);
    return change;
}

}  // namespace regionmesh
