#include "stream/finish.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "judge/error_bound.h"
#include "regionmesh/smooth.h"
#include "smooth/preserve_within.h"
#include "stream/stage_options.h"

namespace regionmesh {

namespace {

/// Called now and then by a stage of an unknown number of sweeps, so many calls each: the share nears 1 ever more
/// slowly.
std::function<void()> progress_of(RunLog& log, WorkStage stage, const char* name, double calls_a_sweep) {
    return [&log, stage, name, calls_a_sweep, calls = 0.0]() mutable {
        log.advance(stage, 1 - std::exp2(-++calls / (2 * calls_a_sweep)));
        log.report_progress(name);
    };
}

}  // namespace

void remesh_faces(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log) {
    if (!options.edge_length) return;
    const StageTimer timer = log.time("remesh");
    const Promises promises = promises_of(options, ground_of(shape));
    RemeshOptions own{.promises = promises, .edge_length = *options.edge_length};
    own.on_progress = progress_of(log, WorkStage::kRemesh, "remesh", 1 + result.mesh.face_end() / 4096.0);
    result.report.remeshed = remesh(result.mesh, own);
    const FloorResult floor = raise_floor(result.mesh, promises);
    if (result.report.floor)
        result.report.floor->follow(floor);
    else
        result.report.floor = floor;
    result.report.error_bound = floor.error_bound;
}

void smooth_lines(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log) {
    if (!options.smooth_lines) return;
    const StageTimer timer = log.time("smooth lines");
    SmoothLinesOptions own{.promises = promises_of(options, ground_of(shape)), .threads = options.threads};
    own.on_progress = progress_of(log, WorkStage::kLines, "smooth lines", 1 + result.mesh.vertex_end() / 4096.0);
    result.report.smoothed_lines = smooth_lines(result.mesh, own);
    result.report.error_bound = result.report.smoothed_lines->error_bound;
}

void improve_faces(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log) {
    if (!options.improve) return;
    const StageTimer timer = log.time("improve");
    ImproveOptions own{.promises = promises_of(options, ground_of(shape))};
    own.on_progress = progress_of(log, WorkStage::kImprove, "improve",
                                  1 + (result.mesh.face_end() + result.mesh.vertex_end()) / 16384.0);
    result.report.improved = improve(result.mesh, own);
    result.report.error_bound = result.report.improved->error_bound;
}

void restore_volumes(Reconstruction& result, const ReconstructOptions& options, const SourceShape& shape, RunLog& log) {
    if (!options.preserve_volume) return;
    const StageTimer timer = log.time("preserve volume");
    const std::vector<double>& before = result.report.unsmoothed_volumes;
    WantedVolumes wanted(before.begin(), before.end());
    for (Label label : result.background)
        if (label < wanted.size()) wanted[label].reset();
    SmoothOptions own = smooth_options(options, shape.scale);
    const Promises promises = promises_of(options, ground_of(shape));
    own.box = ground_of(shape).box;
    result.report.preserved = preserve_volumes_within(result.mesh, wanted, own, promises.max_error);
    result.report.error_bound = largest_error_bound(result.mesh);
}

namespace {

void check_mesh(Reconstruction& result, std::optional<LabelOracle> oracle, const ReconstructOptions& options,
                RunLog& log) {
    log.report_progress("check");
    const StageTimer timer = log.time("check");
    CheckOptions check_options;
    check_options.boundary_is_open = !options.cap;
    check_options.background = result.background;
    check_options.oracle = std::move(oracle);
    check_options.threads = options.threads;
    check_options.label_text = [&](Label label) { return result.labels.text(result.labels.input(label)); };
    result.report.check = check(result.mesh, check_options);
    log.advance(WorkStage::kCheck, 1);
}

}  // namespace

void check_result(Reconstruction& result, FaceSource& source, std::optional<LabelOracle> oracle,
                  const ReconstructOptions& options, RunLog& log) {
    check_mesh(result, std::move(oracle), options, log);
    if (!source.can_compare()) return;
    log.report_progress("samples");
    const StageTimer timer = log.time("samples");
    result.report.samples = source.compare(result.mesh, options.threads);
    log.advance(WorkStage::kSamples, 1);
}

}  // namespace regionmesh
