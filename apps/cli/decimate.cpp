#include <fmt/core.h>

#include "commands.h"
#include "input.h"
#include "messages.h"
#include "output.h"
#include "page_output.h"
#include "printable.h"

namespace regionmesh::cli {
namespace {

/// Simplifies and improves, and reports it as reconstruct does.
Report simplified(Mesh& mesh, const SimplifyOptions& options, bool is_improving) {
    Report report;
    report.initial_faces = report.peak_faces = mesh.face_count();
    report.initial_vertices = mesh.vertex_count();
    {
        const Timer timer(report.seconds["decimate"]);
        const SimplifyResult done = simplify(mesh, options);
        report.verdicts = done.verdicts;
        report.refreshes = done.refreshes;
        report.stopped = to_string(done.stopped);
        report.error_bound = done.error_bound;
        report.bytes_per_face = static_cast<double>(done.bytes) / report.peak_faces;
    }
    if (is_improving) {
        const Timer timer(report.seconds["improve"]);
        report.improved = improve(mesh, improve_options(options));
        report.error_bound = report.improved->error_bound;
    }
    report.final_faces = mesh.face_count();
    report.final_vertices = mesh.vertex_count();
    return report;
}

void print_summary(const std::string& path, const Report& report) {
    say("{}: {} faces (from {}), lowest quality {:.3f}, {}", printable(path), report.final_faces, report.initial_faces,
        report.check.quality.min, counted(report.check.violation_count(), "violation"));
    print_improved(report);
}

}  // namespace

int run_decimate(const Settings& given) {
    const ReconstructOptions& asked = given.reconstruct;
    if (!has_target(given) && !asked.improve)
        throw Error(ErrorCode::kUsage,
                    "decimate: no target; give --target-faces, --reduce or --max-error, or --improve");
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    const BoxAxes axes(file.mesh);
    const CheckReport before = check(file.mesh, options);
    const LockedPart fixed = before.violation_count() > 0 ? lock_violations(file.mesh, options) : LockedPart{};
    Report report = simplified(file.mesh, simplify_options(settings, file.mesh), asked.improve);
    axes.restore(file.mesh);
    file.mesh.compact();  // so that ids in the report are the numbers of points and faces in the written file
    report.check = check(file.mesh, options);
    const auto [names, colours] = describe(settings, file.names, file.colours);
    const Model model{file.mesh, file.labels, options.background, names, colours, file.space};
    OutputFiles files(model_writing(settings));
    const auto written = write_model(settings, model, files);
    write_report_file(settings, report, model, made_by(kDecimate, settings), files);
    if (!settings.html.empty())
        write_page(settings.html, {page_model(settings.output, model)},
                   page_options(kDecimate, settings,
                                report_json(report, file.labels, names, made_by(kDecimate, settings)), false),
                   files);
    files.commit();
    print_region_files(settings, written);
    print_summary(settings.output, report);
    print_fixed_part(fixed, before, report.check);
    print_stop(settings, report);
    return exit_code(report.check);
}

}  // namespace regionmesh::cli
