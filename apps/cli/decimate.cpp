#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"

namespace regionmesh::cli {
namespace {

void print_summary(const Settings& settings, const Report& report) {
    say("{}: {} faces (from {}), lowest quality {:.3f}, {}", output_text(settings), report.final_faces,
        report.initial_faces, report.check.quality.min, counted(report.check.violation_count(), "violation"));
    print_remeshed(report);
    print_smoothed_lines(report);
    print_floor(report);
    print_improved(report);
}

}  // namespace

int run_decimate(const Settings& given) {
    const ReconstructOptions& asked = given.reconstruct;
    if (!has_target(given) && !asked.improve && !asked.smooth_lines && !asked.edge_length)
        throw Error(ErrorCode::kUsage,
                    "decimate: no target; give --target-faces, --reduce, --max-error, --edge-length, --improve or "
                    "--smooth-lines");
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    ModelChange change = simplify_model(file.mesh, settings, options, file.coordinates.spacing);
    Report& report = change.report;
    write_changed(kDecimate, settings, file, options, report);
    print_summary(settings, report);
    print_locked_part(change);
    print_stop(settings, report);
    return exit_code(report.check);
}

}  // namespace regionmesh::cli
