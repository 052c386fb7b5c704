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

int run_remesh(const Settings& given) {
    if (!given.reconstruct.edge_length)
        throw Error(ErrorCode::kUsage, "remesh: no length of edges; give --edge-length");
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    Settings settings = settings_for(given, file);
    settings.reconstruct.decimate = false;
    const CheckOptions options = check_options(settings, file.labels);
    ModelChange change = simplify_model(file.mesh, settings, options, file.coordinates.spacing);
    write_changed(kRemesh, settings, file, options, change.report);
    print_summary(settings, change.report);
    print_locked_part(change);
    return exit_code(change.report.check);
}

}  // namespace regionmesh::cli
