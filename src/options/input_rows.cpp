// Rows of the input: arguments, volumes, points, labels, surfaces.
#include <algorithm>
#include <iterator>

#include "options/bind_option.h"
#include "options/option_rows.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/read_tetrahedra.h"

namespace regionmesh {
namespace {

constexpr Range kLayers{0, 0x7FFFFFFF}, kPositive{.low = 0, .is_low_included = false};
constexpr std::uint64_t kMostBackgroundLabels = 65535;

void choose_sweep(Settings& settings, std::size_t word) {
    constexpr SweepChoice kChoices[] = {SweepChoice::kAuto, SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};
    constexpr std::optional<Sweep> kSweeps[] = {std::nullopt, kSweepX, kSweepY, kSweepZ};
    settings.volume.sweep = kChoices[word];
    settings.reconstruct.sweep = kSweeps[word];
}

std::string labels_text(const std::vector<InputLabel>& labels) {
    std::string text;
    for (const InputLabel label : labels) text += (text.empty() ? "" : " ") + std::to_string(label);
    return text;
}

void add_background(Settings& settings, const std::string& flag, const std::string& text) {
    std::vector<InputLabel>& background = settings.reconstruct.background;
    const bool is_first = std::ranges::none_of(settings.given, [](const auto& v) { return v.first == "background"; });
    if (is_first) background.clear();  // the default
    for (const LabelRange& range : parse_label_ranges(flag, text)) {
        const auto more = static_cast<std::uint64_t>(range.last) - static_cast<std::uint64_t>(range.first);
        if (more > kMostBackgroundLabels)
            refuse_value(flag, text, "a range of at most 65,536 labels, from low to high");
        for (std::uint64_t n = 0; n <= more; ++n)
            background.push_back(static_cast<InputLabel>(static_cast<std::uint64_t>(range.first) + n));
    }
    settings.volume.select.rest = background.front();
}

}  // namespace

Rows argument_rows() {
    static const std::string volumes = "volume (" + volume_extensions() +
                                       "; file.h5:/dataset; - for .npy or raw samples on standard input), folder or "
                                       "list of sections, or table of labelled points "
                                       "or mesh of labelled tetrahedra (" +
                                       tetrahedron_extensions() + ")";
    static const std::string surface = "labelled surface (" + readable_extensions() + "), or a folder of them";
    const auto inputs = [](Settings& s) { return &s.inputs; };
    const auto models = [](Settings& s) { return &s.models; };
    return {
        file_option({.name = "input",
                     .help = volumes,
                     .group = "Arguments",
                     .commands = kReconstruct | kInfo,
                     .is_argument = true,
                     .repeats = true},
                    inputs),
        file_option({.name = "model",
                     .help = surface,
                     .group = "Arguments",
                     .commands = kSurfaceCommands | kVoxelise | kView,
                     .is_argument = true},
                    models),
        file_option({.name = "from", .help = surface, .group = "Arguments", .commands = kConvert, .is_argument = true},
                    models),
        file_option({.name = "to",
                     .help = converted_help(),
                     .group = "Arguments",
                     .commands = kConvert,
                     .is_argument = true,
                     .is_output = true},
                    [](Settings& s) { return &s.output; }),
        file_option({.name = "a", .help = surface, .group = "Arguments", .commands = kCompare, .is_argument = true},
                    models),
        file_option({.name = "b",
                     .help = "the surface to compare it with",
                     .group = "Arguments",
                     .commands = kCompare,
                     .is_argument = true},
                    models),
    };
}

Rows volume_rows() {
    constexpr std::string_view kGroup = "Input";
    constexpr std::uint32_t kFileCommands = kVolumeCommands | kVoxelise;
    Rows rows{
        file_option({.name = "sections",
                     .is_basic = true,
                     .help = "input that the model was made from (volume, points or mesh): compare with its labels",
                     .group = kGroup,
                     .commands = kCheck,
                     .repeats = true},
                    [](Settings& s) { return &s.sections; }),
        file_option({.name = "like",
                     .is_basic = true,
                     .help = "volume with the lattice and the type of samples to write",
                     .group = kGroup,
                     .commands = kVoxelise,
                     .is_required = true,
                     .repeats = true},
                    [](Settings& s) { return &s.sections; }),
        word_option({.name = "sweep",
                     .help = "axis along which sections are read; auto: the axis with the smallest sections",
                     .group = kGroup,
                     .commands = kVolumeCommands},
                    {"auto", "x", "y", "z"}, choose_sweep),
        option(
            {.name = "spacing",
             .is_basic = true,
             .help = "distance between samples along x, y and z: of a volume, instead of that in the file; of layers",
             .group = kGroup,
             .commands = kFileCommands,
             .unit = "length",
             .inputs = kVolumeInput | kTableInput},
            [](Settings& s) { return &s.volume.spacing; }),
        option(
            {.name = "layer",
             .help = "NRRD, HDF5, Zarr and N5: which layer, channel or time to read where a file has several; counted "
                     "from 0",
             .group = kGroup,
             .commands = kFileCommands,
             .inputs = kVolumeInput},
            [](Settings& s) { return &s.volume.layer; }, kLayers),
        option({.name = "max-work",
                .help = "volumes: most samples to read, where each section counts as 4096 more; a small file may "
                        "describe endless ones. layers: most samples and evaluations of surfaces",
                .group = kGroup,
                .commands = kFileCommands,
                .unit = "samples",
                .inputs = kVolumeInput | kTableInput},
               [](Settings& s) { return &s.volume.max_work; }),
        option({.name = "external-files",
                .help = "volumes: the header may name files outside its own folder; for headers that you trust",
                .group = kGroup,
                .commands = kFileCommands,
                .inputs = kVolumeInput},
               [](Settings& s) { return &s.volume.external_files; }),
        option({.name = "size",
                .help = "raw files: samples along x, y and z",
                .group = kGroup,
                .commands = kFileCommands,
                .unit = "samples",
                .inputs = kVolumeInput},
               [](Settings& s) { return &s.volume.raw_size; }),
        special_option({.name = "type",
                        .help = "raw files: type of a sample, little endian: int8, uint8, ... int64, uint64",
                        .group = kGroup,
                        .commands = kFileCommands,
                        .value = "TYPE",
                        .inputs = kVolumeInput},
                       OptionKind::kText,
                       [](Settings& s, const std::string& flag, const std::string& text) {
                           s.volume.raw_type = parse_sample_type(text);
                           if (!s.volume.raw_type) refuse_value(flag, text, "a sample type, such as uint8 or int16");
                       }),
    };
    std::ranges::move(selection_rows(), std::back_inserter(rows));
    return rows;
}

Rows tetrahedra_rows() {
    constexpr std::string_view kGroup = "Points and tetrahedra";
    return {
        option({.name = "columns",
                .help = "tables: which columns are which, as X,Y,Z,LABEL or hole=nr,label=lith ...",
                .group = kGroup,
                .commands = kVolumeCommands,
                .value = "COLUMNS",
                .inputs = kTableInput},
               [](Settings& s) { return &s.tetrahedra.columns; }),
        option(
            {.name = "step",
             .help = "drill holes: largest distance between the points that represent an interval",
             .group = kGroup,
             .commands = kVolumeCommands,
             .unit = "length",
             .inputs = kTableInput},
            [](Settings& s) { return &s.tetrahedra.step; }, kPositive),
        special_option(
            {.name = "layers",
             .is_basic = true,
             .help = "drill holes: interpolate the bases of units between the holes; units from young to old, or auto",
             .group = kGroup,
             .commands = kVolumeCommands,
             .value = "auto|UNITS",
             .inputs = kTableInput},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                if (text.empty()) refuse_value(flag, text, "auto, or units from young to old as clay,sand,chalk");
                s.layers = text;
                s.reconstruct.scale_z = kAutoScale;  // unless --scale-z, a later row, is given
            }),
        special_option({.name = "collars",
                        .help = "drill holes: table of the places of inclined holes, with hole, x, y, surface",
                        .group = kGroup,
                        .commands = kVolumeCommands,
                        .inputs = kTableInput},
                       OptionKind::kFile,
                       [](Settings& s, const std::string&, const std::string& text) { s.tetrahedra.collars = text; }),
        special_option({.name = "surveys",
                        .help = "drill holes: table of their directions, with hole, depth, azimuth, dip",
                        .group = kGroup,
                        .commands = kVolumeCommands,
                        .inputs = kTableInput},
                       OptionKind::kFile,
                       [](Settings& s, const std::string&, const std::string& text) { s.tetrahedra.surveys = text; }),
        file_option({.name = "terrain",
                     .help = "layers: heights of the ground, an ESRI ASCII grid; without it, between the tops of holes",
                     .group = kGroup,
                     .commands = kVolumeCommands,
                     .inputs = kTableInput},
                    [](Settings& s) { return &s.terrain; }),
        special_option({.name = "scale-z",
                        .help = "compute with z times this factor, rounded to a power of two; the model is not scaled. "
                                "auto: from the spacing, or from the holes; the default with --layers",
                        .group = kGroup,
                        .commands = kVolumeCommands,
                        .value = "auto|NUMBER",
                        .range = kPositive.text(),
                        .default_text = "1"},
                       OptionKind::kNumber,
                       [](Settings& s, const std::string& flag, const std::string& text) {
                           const double scale = text == "auto" ? kAutoScale : parse_number(flag, text, kPositive);
                           s.reconstruct.scale_z = s.tetrahedra.scale_z = scale;
                       }),
        option({.name = "array",
                .help = "volumes and meshes: name of the array of labels in a .vti, HDF5 or DREAM.3D file or a mesh",
                .group = kGroup,
                .commands = kVolumeCommands,
                .value = "NAME",
                .inputs = kVolumeInput | kMeshInput},
               [](Settings& s) { return &s.tetrahedra.array; }),
        option({.name = "hull",
                .help = "close regions on the hull of the points; the same as --boundary cap",
                .group = kGroup,
                .commands = kVolumeCommands,
                .inputs = kTableInput | kMeshInput},
               [](Settings& s) { return &s.hull; }),
    };
}

Rows label_rows() {
    constexpr std::string_view kGroup = "Labels";
    constexpr std::uint32_t kBoxed = kReconstruct | kSurfaceCommands | kInfo;
    // Made before the rows: g++ 12 destroys a temporary in a braced list twice where memory runs out.
    const Settings defaults;
    const std::string background = labels_text(defaults.reconstruct.background);
    return {
        special_option({.name = "background",
                        .help = "labels of empty space, as 0 or 0,5-9; their faces with the exterior are not made",
                        .group = kGroup,
                        .commands = kBoxed | kConvert | kCompare | kVoxelise | kView,
                        .value = "LABELS",
                        .repeats = true,
                        .default_text = background},
                       OptionKind::kLabel, add_background),
        special_option({.name = "no-background",
                        .help = "every label is a region",
                        .group = kGroup,
                        .commands = kBoxed | kConvert | kCompare | kVoxelise | kView},
                       OptionKind::kFlag,
                       [](Settings& s, const std::string& flag, const std::string& text) {
                           if (parse_flag(flag, text)) s.reconstruct.background.clear();
                       }),
        word_option({.name = "boundary",
                     .help = "cap: faces on the six sides of the box; open: none there",
                     .group = kGroup,
                     .commands = kBoxed | kView},
                    {"cap", "open"}, [](Settings& s, std::size_t word) { s.reconstruct.cap = word == 0; }),
        word_option({.name = "cells",
                     .help = "how sections are meshed: compact, eight samples at a time, with a third of the faces for "
                             "the same regions and lines; tetrahedra, six for eight samples, as the paper does; auto: "
                             "compact unless taubin, laplacian or nifpms smooths, or volumes are preserved",
                     .group = kGroup,
                     .commands = kReconstruct | kInfo,
                     .inputs = kVolumeInput | kTableInput},
                    {"auto", "compact", "tetrahedra"},
                    [](Settings& s, std::size_t word) { s.reconstruct.cells = static_cast<CellKind>(word); }),
        special_option(
            {.name = "outside",
             .help = "label of samples in no region, where there is no background",
             .group = kGroup,
             .commands = kVoxelise,
             .default_text = std::to_string(defaults.outside)},
            OptionKind::kLabel,
            [](Settings& s, const std::string& flag, const std::string& text) { s.outside = parse_label(flag, text); }),
    };
}

Rows surface_rows() {
    constexpr std::string_view kGroup = "Surfaces to read";
    constexpr std::uint32_t kReaders = kSurfaceCommands | kConvert | kVoxelise | kView;
    return {
        option({.name = "weld",
                .help = "join points no farther apart than this; 0: points at the same place",
                .group = kGroup,
                .commands = kReaders,
                .unit = "length"},
               [](Settings& s) { return &s.surface.weld; }),
        option({.name = "orient",
                .help = "turn faces so that neighbours agree on which side each region lies",
                .group = kGroup,
                .commands = kReaders},
               [](Settings& s) { return &s.surface.orient; }),
    };
}

}  // namespace regionmesh
