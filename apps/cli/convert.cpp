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
constexpr std::array<std::string_view, 1> kOfFiles{"per-region"};
constexpr std::array<std::string_view, 1> kNotOfPieces{"units"};  // options that a .pvtp does not take

/// Throws Error(kUsage) for options of a folder .precomputed with another output, and the other way round. A model that
/// is missing is said first.
void require_fit_of_output(const Settings& settings) {
    if (is_precomputed(settings.output))
        return refuse_options(settings, kOfFiles,
                              "is for files .stl, .obj and .ply, and a folder .precomputed is written");
    if (!std::filesystem::exists(settings.models.front())) return;
    refuse_options(settings, kOfPrecomputed, "is for an output such as model.precomputed");
}

PrecomputedOptions precomputed_options(const Settings& settings, Described described) {
    return {.metres = settings.metres,
            .is_legacy = settings.precomputed_is_legacy,
            .is_sharded = settings.precomputed_is_sharded,
            .levels = settings.precomputed_levels,
            .names = std::move(described.names),
            .colours = std::move(described.colours),
            .output = model_writing(settings)};
}

void print_regions(const Settings& settings, const PrecomputedResult& made) {
    warn_of_rounding(settings.output, made.rounded_share_of_edge, "give --precomputed multi");
    if (!settings.quiet) fmt::print("{}: {}\n", printable(settings.output), counted(made.regions, "region"));
}

/// From a folder of pieces, without the whole model in memory.
void convert_pieces(const Settings& settings) {
    require_fit_of_pieces(settings);
    const std::string& folder = settings.models.front();
    Described described = describe(settings, {}, {});
    if (is_precomputed(settings.output)) {
        print_regions(settings,
                      write_precomputed(folder, settings.output, precomputed_options(settings, std::move(described))));
        return;
    }
    refuse_options(settings, kNotOfPieces,
                   "is not for " + settings.output + ", whose pieces have the unit of the folder");
    const VtpPiecesOptions options{
        .names = std::move(described.names), .colours = std::move(described.colours), .output = settings.writing};
    const std::size_t files = write_vtp_pieces(folder, settings.output, options).size();
    if (!settings.quiet) fmt::print("{}: {}\n", printable(settings.output), counted(files - 1, "piece"));
}

/// From a model in memory.
void convert_whole(const Settings& settings, MeshFile& file, const CheckOptions& options) {
    Described described = describe(settings, file.names, file.colours);
    OutputFiles files(model_writing(settings));
    const Model model{file.mesh,       file.labels,       options.background,
                      described.names, described.colours, with_units_and_space(settings, file.coordinates)};
    if (!is_precomputed(settings.output)) {
        const auto written = write_model(settings, model, files);
        files.commit();
        print_region_files(settings, written);
        if (!settings.quiet)
            fmt::print("{}: {} faces, {} vertices\n", output_text(settings), file.mesh.face_count(),
                       file.mesh.vertex_count());
        return;
    }
    write_tables(settings, model, files);
    PrecomputedOptions writing = precomputed_options(settings, std::move(described));
    writing.metres = model.coordinates.metres;
    writing.background = options.background;
    writing.boundary_is_open = options.boundary_is_open;
    writing.source = settings.models.front();
    print_regions(settings, write_precomputed(std::move(file.mesh), file.labels, settings.output, writing));
    files.commit();
}

}  // namespace

int run_convert(const Settings& given) {
    require_fit_of_output(given);
    if (is_written_in_pieces(given)) {
        convert_pieces(given);
        return kGood;
    }
    if (is_precomputed(given.output))
        require_tables(given);
    else
        require_outputs(given);
    MeshFile file = read_model(given.models.front(), given.surface);
    const Settings settings = settings_for(given, file);
    const CheckOptions options = check_options(settings, file.labels);
    convert_whole(settings, file, options);
    return kGood;
}

}  // namespace regionmesh::cli
