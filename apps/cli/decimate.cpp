#include <fmt/core.h>

#include <cmath>

#include "commands.h"
#include "input_options.h"
#include "mesh_options.h"
#include "output_options.h"
#include "regionmesh/process.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::string mesh, report;
    std::string target_faces, reduce, max_error, min_quality = "0.1", perturbation = "1e-7";
    bool no_intersect_check = false, quiet = false;
    InputOptions input;
    MeshOptions reading;
    OutputOptions output;
};

DecimateOptions to_options(const Arguments& arguments, const Mesh& mesh) {
    DecimateOptions options;
    if (!arguments.target_faces.empty())
        options.target_faces = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(parse_count("--target-faces", arguments.target_faces), mesh.face_count()));
    if (!arguments.reduce.empty())
        options.target_faces = static_cast<std::uint32_t>(
            std::llround(mesh.face_count() * (1 - parse_share("--reduce", arguments.reduce))));
    if (!arguments.max_error.empty()) options.max_error = parse_number("--max-error", arguments.max_error);
    options.min_quality = parse_number("--min-quality", arguments.min_quality);
    options.perturbation = parse_number("--perturbation", arguments.perturbation);
    options.intersect_check = !arguments.no_intersect_check;
    options.scale = typical_edge(mesh);
    return options;
}

/// Decimates; what was done, as reconstruct reports it.
Report decimated(Mesh& mesh, const DecimateOptions& options) {
    Report report;
    report.initial_faces = report.peak_faces = mesh.face_count();
    report.initial_vertices = mesh.vertex_count();
    {
        const Timer timer(report.seconds["decimate"]);
        const std::size_t mesh_bytes = mesh.bytes();
        const DecimateResult done = decimate(mesh, options);
        report.verdicts = done.verdicts;
        report.refreshes = done.refreshes;
        report.stopped = to_string(done.stopped);
        report.bytes_per_face = static_cast<double>(mesh_bytes + done.bytes) / report.peak_faces;
    }
    report.final_faces = mesh.face_count();
    report.final_vertices = mesh.vertex_count();
    return report;
}

int decimate_command(const Arguments& arguments) {
    if (arguments.target_faces.empty() && arguments.reduce.empty() && arguments.max_error.empty())
        throw Error(ErrorCode::kUsage, "decimate: no target; give --target-faces, --reduce or --max-error");
    arguments.output.require_writable(!arguments.input.cap());
    if (!arguments.report.empty()) require_writable(arguments.report);
    MeshFile file = arguments.reading.read(arguments.mesh);
    const CheckOptions check_options = arguments.input.check_options(file.labels);
    const CheckReport before = check(file.mesh, check_options);
    file.mesh.sort_spatially();
    const FixedPart fixed = before.violation_count() > 0 ? fix_unsound(file.mesh, check_options) : FixedPart{};
    Report report = decimated(file.mesh, to_options(arguments, file.mesh));
    report.check = check(file.mesh, check_options);
    const LabelNames names = arguments.output.names_or(file.names);
    arguments.output.write(file.mesh, file.labels, check_options.background, names);
    report.peak_bytes = peak_resident_bytes();
    if (!arguments.report.empty()) write_text(arguments.report, report_json(report, file.labels, names));
    if (!arguments.quiet) {
        fmt::print("{}: {} faces (from {}), quality {:.3f} at worst, {} violations\n", arguments.output.path,
                   report.final_faces, report.initial_faces, report.check.quality.min, report.check.violation_count());
        print_unsound(fixed, before, report.check);
        if (report.stopped == "topology") fmt::print("stopped before the target: no further edge can be collapsed\n");
    }
    return report.check.violation_count() == 0 ? 0 : 3;
}

}  // namespace

void add_decimate(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("decimate", "a labelled surface in, with fewer faces out");
    command->add_option("model", arguments->mesh, kMeshRead)->required();
    arguments->reading.add_options(*command);
    arguments->output.add_options(*command);
    arguments->input.add_label_options(*command);
    command->add_option("--target-faces", arguments->target_faces, "at most so many faces");
    command->add_option("--reduce", arguments->reduce, "remove this share of the faces, such as 90%");
    command->add_option("--max-error", arguments->max_error, "as far as this rms distance allows");
    command->add_option("--min-quality", arguments->min_quality, "least quality of a face that decimation makes");
    command->add_option("--perturbation", arguments->perturbation, "largest cost added to tell equal edges apart");
    command->add_flag("--no-intersect-check", arguments->no_intersect_check, "let faces cross; faster");
    command->add_option("--report", arguments->report, "JSON report to write");
    command->add_flag("--quiet", arguments->quiet, "no summary");
    command->callback([arguments, &action] { action = [arguments] { return decimate_command(*arguments); }; });
}

}  // namespace regionmesh::cli
