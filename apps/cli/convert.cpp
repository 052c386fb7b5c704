#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include "blocks.h"
#include "commands.h"
#include "input.h"
#include "output.h"
#include "printable.h"

namespace regionmesh::cli {

namespace {

constexpr std::array<std::string_view, 3> kOfPrecomputed{"precomputed", "levels", "sharded"};

/// Throws Error(kUsage) for options of a folder .precomputed with another output. A model that is missing is said
/// first.
void require_fit_of_output(const Settings& settings) {
    if (is_precomputed(settings.output) || !std::filesystem::exists(settings.models.front())) return;
    refuse_options(settings, kOfPrecomputed, "is for an output such as model.precomputed");
}

/// From a folder of pieces, without the whole model in memory. Whether the output is of such a format.
bool convert_pieces(const Settings& settings) {
    const std::string& folder = settings.models.front();
    if (!is_written_in_pieces(settings.output)) return false;
    require_fit_of_pieces(settings);
    auto [names, colours] = describe(settings, {}, {});
    if (settings.output.ends_with(".pvtp")) {
        const VtpPiecesOptions options{
            .names = std::move(names), .colours = std::move(colours), .output = settings.writing};
        const std::size_t files = write_vtp_pieces(folder, settings.output, options).size();
        if (!settings.quiet) fmt::print("{}: {}\n", printable(settings.output), counted(files - 1, "piece"));
    } else {
        const PrecomputedOptions options{.metres = settings.metres.value_or(1),
                                         .is_legacy = settings.precomputed_is_legacy,
                                         .is_sharded = settings.precomputed_is_sharded,
                                         .levels = settings.precomputed_levels,
                                         .names = std::move(names),
                                         .colours = std::move(colours),
                                         .output = settings.writing};
        const PrecomputedResult made = write_precomputed(folder, settings.output, options);
        warn_of_rounding(settings.output, made.rounded_share_of_edge, "give --precomputed multi");
        if (!settings.quiet) fmt::print("{}: {}\n", printable(settings.output), counted(made.regions, "region"));
    }
    return true;
}

}  // namespace

int run_convert(const Settings& given) {
    require_fit_of_output(given);
    if (convert_pieces(given)) return kGood;
    require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    BoxAxes(file.mesh).restore(file.mesh);  // which finds the sides of an oblique box
    const CheckOptions options = check_options(settings, file.labels);
    const auto [names, colours] = describe(settings, file.names, file.colours);
    OutputFiles files(model_writing(settings));
    const auto written =
        write_model(settings, {file.mesh, file.labels, options.background, names, colours, file.space}, files);
    files.commit();
    print_region_files(settings, written);
    if (!settings.quiet)
        fmt::print("{}: {} faces, {} vertices\n", printable(settings.output), file.mesh.face_count(),
                   file.mesh.vertex_count());
    return kGood;
}

}  // namespace regionmesh::cli
