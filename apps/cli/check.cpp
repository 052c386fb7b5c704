#include <fmt/core.h>

#include "commands.h"
#include "input_options.h"
#include "mesh_options.h"
#include "tetrahedra_options.h"

namespace regionmesh::cli {
namespace {

struct Arguments {
    std::string mesh, json;
    std::vector<std::string> sections;
    std::uint32_t threads = 0;
    bool quiet = false;
    InputOptions input;
    TetrahedraArguments tetrahedra;
    MeshOptions reading;
};

/// The oracle in the dense labels of the model's table; labels that the model does not know get numbers of their own.
template <class AnyCensus>
LabelOracle translate(const AnyCensus& census, LabelTable& labels) {
    LabelOracle oracle = census.oracle;
    std::vector<std::int64_t> euler;
    for (Label dense = 0; dense < oracle.euler.size(); ++dense) {
        const Label there = labels.dense(census.labels.input(dense));
        if (there >= euler.size()) euler.resize(there + 1, 0);
        euler[there] = oracle.euler[dense];
    }
    oracle.euler = std::move(euler);
    return oracle;
}

void print_findings(const std::string& name, const CheckReport& report) {
    fmt::print(
        "{}: {} regions, {} pairs with an interface, {} quadruple points inside, quality {:.3f} at worst, {:.3f} on "
        "average\n",
        name, report.regions.size(), report.region_pairs, report.quadruple_points_inside, report.quality.min,
        report.quality.mean);
    for (int kind = 0; kind < kViolationKindCount; ++kind) {
        if (!report.counts[kind]) continue;
        fmt::print("violation {}: {}\n", to_string(static_cast<ViolationKind>(kind)), report.counts[kind]);
        int shown = 0;
        for (const Violation& violation : report.violations)
            if (violation.kind == static_cast<ViolationKind>(kind) && shown++ < 3) fmt::print("  {}\n", violation.text);
    }
    if (report.violation_count() == 0) fmt::print("no violations\n");
    print_orient_hint(report);
}

/// Where the model was made from a lattice.
std::optional<SampleAgreement> compare_with_sections(const Arguments& arguments, MeshFile& file,
                                                     const CheckOptions& options) {
    if (arguments.sections.empty() || arguments.tetrahedra.is_meant(arguments.sections, arguments.input)) return {};
    return compare_samples(file.mesh, file.labels, options.background, *arguments.input.open(arguments.sections));
}

void print_samples(const SampleAgreement& samples) {
    if (samples.wrong == 0)
        fmt::print("every one of {} samples keeps its label\n", samples.samples);
    else
        fmt::print("{} of {} samples lie in another region; Dice {:.6f}\n", samples.wrong, samples.samples,
                   samples.dice());
}

int check_command(const Arguments& arguments) {
    MeshFile file = arguments.reading.read(arguments.mesh);
    CheckOptions options = arguments.input.check_options(file.labels);
    options.threads = arguments.threads;
    if (!arguments.sections.empty()) {
        options.oracle = with_reader(arguments.sections, arguments.input, arguments.tetrahedra, [&](auto& reader) {
            return translate(count_labels(reader, arguments.input.census_options()), file.labels);
        });
    }
    const CheckReport report = check(file.mesh, options);
    const auto samples = compare_with_sections(arguments, file, options);
    if (!arguments.json.empty())
        write_text(arguments.json, check_json(report, file.labels, file.names, samples ? &*samples : nullptr));
    if (!arguments.quiet) {
        print_findings(arguments.mesh, report);
        if (samples) print_samples(*samples);
    }
    return report.violation_count() == 0 ? 0 : 3;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "check", "looks for cracks, folds, crossings and changes of topology; exit 3 if there are any");
    command->add_option("model", arguments->mesh, kMeshRead)->required();
    arguments->reading.add_options(*command);
    command->add_option("--sections", arguments->sections,
                        "the volume, points or mesh that the model was made from: compare with its labels");
    arguments->input.add_volume_options(*command);
    arguments->input.add_label_options(*command);
    arguments->tetrahedra.add_options(*command);
    command->add_option("--json", arguments->json, "findings to write as JSON");
    command->add_option("--threads", arguments->threads,
                        "threads at work; one per core if not given. The findings are the same");
    command->add_flag("--quiet", arguments->quiet, "exit code only");
    command->callback([arguments, &action] { action = [arguments] { return check_command(*arguments); }; });
}

}  // namespace regionmesh::cli
