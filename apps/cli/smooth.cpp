#include <fmt/core.h>

#include "commands.h"
#include "input_options.h"
#include "mesh_options.h"
#include "output_options.h"
#include "regionmesh/process.h"
#include "smooth_arguments.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::string mesh, report, min_quality = "0.1", scale;
    std::uint32_t threads = 0;
    bool preserve_volume = false, no_intersect_check = false, quiet = false;
    SmoothArguments smooth;
    InputOptions input;
    MeshOptions reading;
    OutputOptions output;
};

SmoothOptions to_options(const Arguments& arguments, const Mesh& mesh) {
    SmoothOptions options = arguments.smooth.options();
    options.min_quality = parse_number("--min-quality", arguments.min_quality);
    options.intersect_check = !arguments.no_intersect_check;
    options.threads = arguments.threads;
    options.scale = arguments.scale.empty() ? typical_edge(mesh) : parse_number("--scale", arguments.scale);
    if (options.scale <= 0) throw Error(ErrorCode::kInput, "--scale " + arguments.scale + ": not a length above 0");
    return options;
}

WantedVolumes wanted_volumes(const CheckReport& report) {
    WantedVolumes wanted;
    for (const RegionReport& region : report.regions) {
        if (region.label >= wanted.size()) wanted.resize(region.label + 1);
        wanted[region.label] = region.volume;
    }
    return wanted;
}

int smooth_command(const Arguments& arguments) {
    if (arguments.preserve_volume && !arguments.input.cap())
        throw Error(ErrorCode::kInput, "--preserve-volume: open regions have no volume; leave out --boundary open");
    arguments.output.require_writable(!arguments.input.cap());
    if (!arguments.report.empty()) require_writable(arguments.report);
    MeshFile file = arguments.reading.read(arguments.mesh);
    const CheckOptions check_options = arguments.input.check_options(file.labels);
    Report report;
    report.initial_faces = file.mesh.face_count();
    report.initial_vertices = file.mesh.vertex_count();
    const CheckReport before = check(file.mesh, check_options);
    const FixedPart fixed = before.violation_count() > 0 ? fix_unsound(file.mesh, check_options) : FixedPart{};
    {
        const Timer timer(report.seconds["smooth"]);
        report.smoothing = smooth(file.mesh, to_options(arguments, file.mesh));
    }
    report.unsmoothed_volumes = report.smoothing.volume_before;
    if (arguments.preserve_volume) {
        const Timer timer(report.seconds["preserve volume"]);
        report.preserved = preserve_volumes(file.mesh, wanted_volumes(before), to_options(arguments, file.mesh));
    }
    report.check = check(file.mesh, check_options);
    report.final_faces = report.initial_faces;
    report.final_vertices = report.initial_vertices;
    report.stopped = "none asked";
    const LabelNames names = arguments.output.names_or(file.names);
    arguments.output.write(file.mesh, file.labels, check_options.background, names);
    report.peak_bytes = peak_resident_bytes();
    if (!arguments.report.empty()) write_text(arguments.report, report_json(report, file.labels, names));
    if (!arguments.quiet) {
        fmt::print(
            "{}: {} vertices, {} stepped back, moved by {:.3g} at most; quality {:.3f} at worst, {} violations (before "
            "{})\n",
            arguments.output.path, report.smoothing.vertices, report.smoothing.backtracked,
            report.smoothing.largest_displacement, report.check.quality.min, report.check.violation_count(),
            before.violation_count());
        print_unsound(fixed, before, report.check);
    }
    return report.check.violation_count() == 0 ? 0 : 3;
}

}  // namespace

void add_smooth(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("smooth", "a labelled surface in, the same without steps out");
    command->add_option("model", arguments->mesh, kMeshRead)->required();
    arguments->reading.add_options(*command);
    arguments->output.add_options(*command);
    arguments->smooth.add_options(*command);
    arguments->input.add_label_options(*command);
    command->add_flag("--preserve-volume", arguments->preserve_volume,
                      "in the end, give every region the volume that it had");
    command->add_option("--min-quality", arguments->min_quality, "no face falls below this quality, unless it was");
    command->add_option("--scale", arguments->scale, "sample spacing, the unit of nifpms; the mean edge if not given");
    command->add_option("--threads", arguments->threads,
                        "threads at work; one per core if not given. The model is the same");
    command->add_flag("--no-intersect-check", arguments->no_intersect_check, "let faces cross; faster");
    command->add_option("--report", arguments->report, "JSON report to write");
    command->add_flag("--quiet", arguments->quiet, "no summary");
    command->callback([arguments, &action] { action = [arguments] { return smooth_command(*arguments); }; });
}

}  // namespace regionmesh::cli
