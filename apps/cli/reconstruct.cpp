#include <fmt/core.h>

#include "commands.h"
#include "input_options.h"
#include "output_options.h"
#include "progress_line.h"
#include "smooth_arguments.h"
#include "tetrahedra_options.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::vector<std::string> inputs;
    std::string report;
    std::string target_faces, reduce, max_error, min_quality = "0.1", memory = "2GiB", face_budget,
                                                 perturbation = "1e-7";
    std::uint32_t threads = 0;
    bool preserve_volume = false, no_decimate = false, no_intersect_check = false, quiet = false;
    SmoothArguments smooth;
    InputOptions input;
    TetrahedraArguments tetrahedra;
    OutputOptions output;
};

ReconstructOptions to_options(const Arguments& arguments) {
    ReconstructOptions options;
    if (!arguments.target_faces.empty()) options.target_faces = parse_count("--target-faces", arguments.target_faces);
    if (!arguments.reduce.empty()) options.reduce = parse_share("--reduce", arguments.reduce);
    if (!arguments.max_error.empty()) options.max_error = parse_number("--max-error", arguments.max_error);
    if (!arguments.face_budget.empty()) options.face_budget = parse_count("--face-budget", arguments.face_budget);
    options.smooth = arguments.smooth.options();
    options.min_quality = parse_number("--min-quality", arguments.min_quality);
    options.perturbation = parse_number("--perturbation", arguments.perturbation);
    options.memory = parse_bytes("--memory", arguments.memory);
    options.threads = arguments.threads;
    options.preserve_volume = arguments.preserve_volume;
    options.decimate = !arguments.no_decimate;
    options.intersect_check = !arguments.no_intersect_check;
    options.background = arguments.input.background_labels();
    options.cap = arguments.input.cap();
    options.sweep = arguments.input.sweep_of_tetrahedra();
    if (options.preserve_volume && !options.cap)
        throw Error(ErrorCode::kInput,
                    "--preserve-volume: regions without caps have no volume; leave out --boundary open");
    return options;
}

void print_volumes(const Report& report) {
    const PreserveReport& preserved = report.preserved;
    if (preserved.rounds == 0) return;
    fmt::print("volumes of regions off by {:.1e} at most, relative; {:.1e} before the correction\n", preserved.drift,
               preserved.drift_before);
    if (preserved.regions_off > 0)
        fmt::print("{} regions could not be brought within {:.0e}\n", preserved.regions_off, kVolumeTolerance);
}

/// What topology or the largest error leave is not known beforehand.
void print_memory(const Arguments& arguments, const Report& report) {
    const std::uint64_t asked = parse_bytes("--memory", arguments.memory);
    if (!arguments.face_budget.empty() || report.peak_bytes <= asked + asked / 10) return;
    fmt::print("more than --memory {}: what the model needs on the way was not known beforehand\n", arguments.memory);
}

void print_summary(const Arguments& arguments, const Report& report) {
    fmt::print("{}: {} faces, {} vertices (from {} faces)\n", arguments.output.path, report.final_faces,
               report.final_vertices, report.initial_faces);
    fmt::print(
        "quality {:.3f} at worst, {:.3f} on average; {} regions, {} pairs with an interface, {} quadruple points "
        "inside\n",
        report.check.quality.min, report.check.quality.mean, report.check.regions.size(), report.check.region_pairs,
        report.check.quadruple_points_inside);
    if (report.stopped == "topology")
        fmt::print(
            "stopped before the target: no further edge can be collapsed without changing topology, folding, crossing "
            "or bad faces\n");
    if (report.stopped == "max_error") fmt::print("stopped at the largest error allowed\n");
    if (report.pinned_vertices > 0)
        fmt::print("{} vertices left as they came: the mesh touches itself there, or more than four regions meet\n",
                   report.pinned_vertices);
    print_volumes(report);
    fmt::print("{:.2f} s, {:.0f} k faces/s, {} MB at most\n", report.seconds.at("total"),
               static_cast<double>(report.initial_faces) / 1e3 / std::max(report.seconds.at("total"), 1e-9),
               report.peak_bytes / 1000000);
    print_memory(arguments, report);
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (report.check.counts[kind])
            fmt::print("violation {}: {}\n", to_string(static_cast<ViolationKind>(kind)), report.check.counts[kind]);
}

/// From whatever the input is; `names` become those of its labels.
Reconstruction reconstruct_input(const Arguments& arguments, const ReconstructOptions& options, LabelNames& names) {
    ProgressLine line(arguments.quiet);
    return with_reader(arguments.inputs, arguments.input, arguments.tetrahedra, [&](auto& reader) {
        names = arguments.output.names_or(reader.info().names);
        Reconstruction made = reconstruct(reader, options, [&](const Progress& progress) { line.show(progress); });
        line.clear();
        return made;
    });
}

int reconstruct_command(const Arguments& arguments) {
    const ReconstructOptions options = to_options(arguments);
    arguments.output.require_writable(!options.cap);
    if (!arguments.report.empty()) require_writable(arguments.report);
    LabelNames names;
    Reconstruction made = reconstruct_input(arguments, options, names);
    double writing = 0;
    {
        const Timer timer(writing);
        arguments.output.write(made.mesh, made.labels, made.background, names);
    }
    Report& report = made.report;
    report.seconds["write"] = writing;
    report.seconds["total"] += writing;
    report.peak_bytes = peak_resident_bytes();
    if (!arguments.report.empty()) write_text(arguments.report, report_json(report, made.labels, names));
    if (!arguments.quiet) print_summary(arguments, report);
    return report.check.violation_count() == 0 ? 0 : 3;
}

}  // namespace

void add_reconstruct(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "reconstruct", "sections, points or tetrahedra in, a conforming, simplified, checked model out");
    command
        ->add_option(
            "input", arguments->inputs,
            "volume (.npy .nii.gz .nrrd .mha .vti .tif .h5:/dataset .dream3d .zarr ...), directory of sections, "
            "list of sections, table of labelled points (.csv .tsv), or mesh of tetrahedra (.vtu .msh)")
        ->required();
    arguments->output.add_options(*command);
    arguments->input.add_volume_options(*command);
    arguments->input.add_label_options(*command);
    arguments->tetrahedra.add_options(*command);
    command->add_option("--target-faces", arguments->target_faces, "decimate to at most so many faces");
    command->add_option("--reduce", arguments->reduce, "remove this share of the faces, such as 90%");
    command->add_option("--max-error", arguments->max_error,
                        "decimate as far as this rms distance allows, in the unit of the spacing");
    command->add_option("--min-quality", arguments->min_quality,
                        "least quality of a face that smoothing or decimation makes; 0.26 is equilateral");
    arguments->smooth.add_options(*command);
    command->add_flag("--preserve-volume", arguments->preserve_volume,
                      "in the end, give every region the volume it had before smoothing and decimation");
    command->add_option("--memory", arguments->memory,
                        "stay within this, such as 500MiB or 2GiB; says before the work begins if it cannot");
    command->add_option("--face-budget", arguments->face_budget,
                        "most faces held at once, instead of one derived from --memory");
    command->add_option("--threads", arguments->threads,
                        "threads at work; one per core if not given. The model is the same");
    command->add_option("--perturbation", arguments->perturbation, "largest cost added to tell equal edges apart");
    command->add_flag("--no-decimate", arguments->no_decimate, "the plain reconstruction");
    command->add_flag("--no-intersect-check", arguments->no_intersect_check, "let faces cross; faster");
    command->add_option("--report", arguments->report, "JSON report to write");
    command->add_flag("--quiet", arguments->quiet, "no progress, no summary");
    command->callback([arguments, &action] { action = [arguments] { return reconstruct_command(*arguments); }; });
}

}  // namespace regionmesh::cli
