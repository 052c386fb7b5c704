#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "commands.h"
#include "input.h"
#include "output.h"

namespace regionmesh::cli {
namespace {

SimplifyOptions to_options(const Settings& settings, const Mesh& mesh) {
    const ReconstructOptions& asked = settings.reconstruct;
    SimplifyOptions options;
    if (asked.target_faces)
        options.target_faces =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(*asked.target_faces, mesh.face_count()));
    if (asked.reduce)
        options.target_faces = static_cast<std::uint32_t>(std::llround(mesh.face_count() * (1 - *asked.reduce)));
    if (asked.max_error) options.max_error = *asked.max_error;
    options.min_quality = asked.min_quality;
    options.perturbation = asked.perturbation;
    options.intersect_check = asked.intersect_check;
    options.placement = asked.placement;
    options.threads = asked.threads;
    options.scale = typical_edge(mesh);
    return options;
}

/// Simplifies, and reports it as reconstruct does.
Report simplified(Mesh& mesh, const SimplifyOptions& options) {
    Report report;
    report.initial_faces = report.peak_faces = mesh.face_count();
    report.initial_vertices = mesh.vertex_count();
    {
        const Timer timer(report.seconds["decimate"]);
        const SimplifyResult done = simplify(mesh, options);
        report.verdicts = done.verdicts;
        report.refreshes = done.refreshes;
        report.stopped = to_string(done.stopped);
        report.bytes_per_face = static_cast<double>(done.bytes) / report.peak_faces;
    }
    report.final_faces = mesh.face_count();
    report.final_vertices = mesh.vertex_count();
    return report;
}

void print_summary(const std::string& path, const Report& report) {
    fmt::print("{}: {} faces (from {}), lowest quality {:.3f}, {} violations\n", path, report.final_faces,
               report.initial_faces, report.check.quality.min, report.check.violation_count());
    if (report.stopped == "topology") fmt::print("stopped before the target: no further edge can be collapsed\n");
}

}  // namespace

int run_decimate(const Settings& given) {
    const ReconstructOptions& asked = given.reconstruct;
    if (!asked.target_faces && !asked.reduce && !asked.max_error)
        throw Error(ErrorCode::kUsage, "decimate: no target; give --target-faces, --reduce or --max-error");
    require_outputs(given);
    MeshFile file = read_mesh(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    const CheckReport before = check(file.mesh, options);
    const LockedPart fixed = before.violation_count() > 0 ? lock_violations(file.mesh, options) : LockedPart{};
    Report report = simplified(file.mesh, to_options(settings, file.mesh));
    file.mesh.compact();  // so that ids in the report are the numbers of points and faces in the written file
    report.check = check(file.mesh, options);
    const LabelNames names = names_or(settings, file.names);
    write_model(settings, file.mesh, file.labels, options.background, {names, file.space});
    write_report_file(settings, report, file.labels, names);
    if (!settings.quiet) {
        print_summary(settings.output, report);
        print_fixed_part(fixed, before, report.check);
    }
    return exit_code(report.check);
}

}  // namespace regionmesh::cli
