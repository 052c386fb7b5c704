// Rows of files to write, and of resources that the run may use.
#include <algorithm>
#include <array>
#include <string_view>

#include "formats/text/length_unit.h"
#include "options/bind_option.h"
#include "options/option_rows.h"

namespace regionmesh {
namespace {

constexpr Range kAnyThreads{0, 0xFFFFFFFFu}, kAnyFaces{1, 0xFFFFFFFFu}, kBlockCells{1, 1u << 20}, kLevels{0, 8};
constexpr std::array<std::string_view, 8> kUnits{"km", "m", "cm", "mm", "um", "nm", "ft", "in"};

std::string_view output_help() {
    static const std::string text =
        std::string(written_help()) +
        "; voxelise: labels to write: .npy .nii .nii.gz .nrrd .raw; view: page to write (.html)";
    return text;
}

}  // namespace

std::string_view written_help() {
    static const std::string text = "model to write: " + writable_extensions();
    return text;
}

std::string_view converted_help() {
    static const std::string text =
        std::string(written_help()) + "; a folder .precomputed; .pvtp of a folder of pieces";
    return text;
}

Rows output_rows() {
    constexpr std::string_view kGroup = "Output";
    constexpr std::uint32_t kAllWriters = kWriters | kConvert | kVoxelise | kCheck | kCompare | kInfo;
    return {
        file_option({.name = "output",
                     .is_basic = true,
                     .help = output_help(),
                     .group = kGroup,
                     .commands = kWriters | kVoxelise | kView,
                     .is_required = true,
                     .is_output = true,
                     .letter = 'o'},
                    [](Settings& s) { return &s.output; }),
        option(
            {.name = "block-size",
             .help = "cells along each axis of a block, for models larger than memory: the output is a folder of "
                     "pieces, and a run that was ended goes on; from --memory if not given and --output is a folder",
             .group = kGroup,
             .commands = kReconstruct,
             .unit = "cells",
             .inputs = kVolumeInput},
            [](Settings& s) { return &s.block_cells; }, kBlockCells),
        file_option({.name = "names",
                     .is_basic = true,
                     .help = "table of labels, names and colours (.csv .tsv .txt .xml), instead of those in the input",
                     .group = kGroup,
                     .commands = kWriters | kConvert | kView},
                    [](Settings& s) { return &s.names; }),
        option({.name = "per-region",
                .help = "one file for each region, MODEL-NAME or MODEL-LABEL: .stl, .obj and .ply",
                .group = kGroup,
                .commands = kWriters | kConvert},
               [](Settings& s) { return &s.per_region; }),
        option({.name = "ascii",
                .help = "write .stl as text: doubles, and a solid with a name for each region; otherwise it is binary",
                .group = kGroup,
                .commands = kWriters | kConvert},
               [](Settings& s) { return &s.ascii; }),
        word_option(
            {.name = "space",
             .help = "space of the model: keep that of the input, or turn it so that x and y point as in ras or lps",
             .group = kGroup,
             .commands = kWriters | kConvert},
            {"keep", "ras", "lps"},
            [](Settings& s, std::size_t word) {
                constexpr Space kSpaces[] = {Space::kUnknown, Space::kRas, Space::kLps};
                s.volume.space = s.surface.space = kSpaces[word];
            }),
        without_default(word_option(
            {.name = "units",
             .help = "unit of length; if not given, the one that the input says. .glb (metres) and .precomputed "
                     "(nanometres) are scaled by it; .vtp, .vtu, .ply, .obj and .3mf state it",
             .group = kGroup,
             .commands = kWriters | kConvert},
            {kUnits.begin(), kUnits.end()},
            [](Settings& s, std::size_t word) { s.metres = formats::metres_in(kUnits[word]); })),
        word_option({.name = "precomputed",
                     .help = "meshes in a folder .precomputed for Neuroglancer: multi, levels of detail compressed by "
                             "Draco; legacy: the model, not compressed",
                     .group = kGroup,
                     .commands = kConvert},
                    {"multi", "legacy"}, [](Settings& s, std::size_t word) { s.precomputed_is_legacy = word == 1; }),
        option(
            {.name = "levels",
             .help = "levels of detail in a folder .precomputed, each with an eighth of the faces of the one before; "
                     "0: as many as leave 20,000 faces",
             .group = kGroup,
             .commands = kConvert},
            [](Settings& s) { return &s.precomputed_levels; }, kLevels),
        option({.name = "sharded",
                .help = "few large files in a folder .precomputed instead of two for each region",
                .group = kGroup,
                .commands = kConvert},
               [](Settings& s) { return &s.precomputed_is_sharded; }),
        file_option({.name = "regions",
                     .help = "CSV table to write: volume, area, centroid, box, neighbours and curvature of each region",
                     .group = kGroup,
                     .commands = kWriters | kConvert | kCheck,
                     .is_output = true},
                    [](Settings& s) { return &s.regions; }),
        file_option({.name = "interfaces",
                     .help = "CSV table to write: area, centroid, mean curvature and line length of each interface",
                     .group = kGroup,
                     .commands = kWriters | kConvert | kCheck,
                     .is_output = true},
                    [](Settings& s) { return &s.interfaces; }),
        file_option({.name = "lines",
                     .help = "CSV table to write: length and dihedral angles of each line where three labels meet",
                     .group = kGroup,
                     .commands = kWriters | kConvert | kCheck,
                     .is_output = true},
                    [](Settings& s) { return &s.lines; }),
        file_option(
            {.name = "write-labels",
             .help = "volume to write with the labels that --denoise or --room left: .npy .nii .nii.gz .nrrd .raw",
             .group = kGroup,
             .commands = kReconstruct,
             .inputs = kVolumeInput | kTableInput,
             .is_output = true},
            [](Settings& s) { return &s.write_labels; }),
        file_option({.name = "report",
                     .is_basic = true,
                     .help = "JSON report to write",
                     .group = kGroup,
                     .commands = kWriters,
                     .is_output = true},
                    [](Settings& s) { return &s.report; }),
        option({.name = "force", .help = "replace files that are read-only", .group = kGroup, .commands = kAllWriters},
               [](Settings& s) { return &s.writing.force; }),
        inverted_flag(
            {.name = "no-sync",
             .help = "do not force files to disk before they get their names: faster, but a loss of power may "
                     "leave them empty",
             .group = kGroup,
             .commands = kAllWriters},
            [](Settings& s) { return &s.writing.sync; }),
        file_option({.name = "json",
                     .help = "JSON file to write with all findings",
                     .group = kGroup,
                     .commands = kCheck | kCompare | kInfo,
                     .is_output = true},
                    [](Settings& s) { return &s.json; }),
        option({.name = "all", .help = "list all labels, not the first 20", .group = kGroup, .commands = kInfo},
               [](Settings& s) { return &s.list_all; }),
        file_option({.name = "html",
                     .is_basic = true,
                     .help = "page to write that shows the model and the report in a browser",
                     .group = kGroup,
                     .commands = kWriters | kCheck | kCompare,
                     .is_output = true},
                    [](Settings& s) { return &s.html; }),
        option(
            {.name = "preview-faces",
             .help = "largest number of faces in the page; a larger model is simplified for it",
             .group = kGroup,
             .commands = kWriters | kCheck | kCompare | kView,
             .unit = "faces"},
            [](Settings& s) { return &s.preview_faces; }, kAnyFaces),
    };
}

Rows run_rows() {
    constexpr std::string_view kGroup = "Run";
    const Settings defaults;  // not made in the braced list: input_rows.cpp says why
    return {
        file_option({.name = "config",
                     .help = "options in a file: name = value lines (.toml), or the report of an earlier run (.json). "
                             "Those on the command line come first",
                     .group = kGroup,
                     .commands = kEveryCommand},
                    [](Settings& s) { return &s.config; }),
        special_option(
            {.name = "memory",
             .help =
                 "memory that the work is planned for, such as 500MiB; too little is refused before it starts. A plan, "
                 "not a limit: --memory-limit",
             .group = kGroup,
             .commands = kReconstruct,
             .unit = "bytes",
             .range = "above 0",
             .default_text = bytes_text(defaults.reconstruct.memory)},
            OptionKind::kBytes,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.reconstruct.memory = parse_bytes(flag, text);
            }),
        word_option(
            {.name = "memory-limit",
             .help = "what --memory is: plan, the run warns and exceeds it, by half and more, where topology or "
                     "--max-error "
                     "leave more faces than it has room for; hard, the run ends with exit code 1 and no output instead",
             .group = kGroup,
             .commands = kReconstruct},
            {"plan", "hard"}, [](Settings& s, std::size_t word) { s.memory_is_hard = word == 1; }),
        option(
            {.name = "face-budget",
             .help = "largest number of faces in memory at a time, whatever memory that takes; derived from --memory "
                     "if not given",
             .group = kGroup,
             .commands = kReconstruct,
             .unit = "faces"},
            [](Settings& s) { return &s.reconstruct.face_budget; }),
        option(
            {.name = "threads",
             .help = "number of threads; 0: one per core. The result is the same for any number",
             .group = kGroup,
             .commands = kFinishers | kSmooth | kCheck | kCompare | kView},
            [](Settings& s) { return &s.reconstruct.threads; }, kAnyThreads),
        inverted_flag(
            {.name = "no-sandbox",
             .help = "let the program do all that you may do; otherwise it writes in the folders of its outputs alone, "
                     "makes no network connections and starts no programs but its own, where the kernel can enforce it",
             .group = kGroup,
             .commands = kAllCommands},
            [](Settings& s) { return &s.sandbox; }),
        option({.name = "require-sandbox",
                .help = "end with exit code 1 where the kernel cannot enforce that",
                .group = kGroup,
                .commands = kAllCommands},
               [](Settings& s) { return &s.needs_sandbox; }),
        option({.name = "quiet",
                .help = "print nothing but errors, and why a target was missed",
                .group = kGroup,
                .commands = kWriters | kCheck | kConvert | kCompare | kVoxelise | kView},
               [](Settings& s) { return &s.quiet; }),
        option({.name = "verbose",
                .help = "print more: what smoothing did, why edges stayed, seconds by stage",
                .group = kGroup,
                .commands = kReconstruct},
               [](Settings& s) { return &s.verbose; }),
        file_option({.name = "log",
                     .help = "text file to write during the run: the command, the stages and all messages, with times",
                     .group = kGroup,
                     .commands = kWriters,
                     .is_output = true},
                    [](Settings& s) { return &s.log; }),
    };
}

}  // namespace regionmesh
