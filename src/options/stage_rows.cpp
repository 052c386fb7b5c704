// Rows of the stages: decimation, smoothing, quality and crossing, comparison.
#include <algorithm>

#include "base/option_range.h"
#include "options/bind_option.h"
#include "options/option_rows.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

constexpr Range kQualities{kQualityRange.least, kQualityRange.most}, kRoom{kRoomRange.least, kRoomRange.most},
    kDenoise{0, kMostDenoise}, kSpecks{0, static_cast<double>(kMostSpeck)}, kPasses{0, kMostSmoothPasses},
    kBetween{0, kMostBetween}, kSampleCounts{1, 1e9}, kShareRange{0, 1}, kLengths{kLeastLength, kMostLength};

/// Passes of taubin, laplacian and nifpms, and largest blocks of lattice.
struct Strength {
    std::string_view word;
    std::uint32_t passes;
    double reach;
};
constexpr Strength kStrengths[] = {{"off", 0, 0}, {"light", 5, 4}, {"normal", 20, 0}, {"strong", 100, 16}};

void choose_strength(Settings& settings, const std::string& flag, const std::string& text) {
    SmoothOptions& smooth = settings.reconstruct.smooth;
    const auto known = std::ranges::find(kStrengths, text, &Strength::word);
    if (known == std::end(kStrengths)) {
        if (text.find_first_not_of("0123456789") != std::string::npos)
            refuse_value(flag, text, "off, light, normal, strong or a whole number of " + kPasses.text());
        smooth.passes = static_cast<std::uint32_t>(parse_count(flag, text, kPasses));
        return;
    }
    smooth.passes = known->passes;
    smooth.reach = known->reach;
}

void choose_between(Settings& settings, const std::string& flag, const std::string& text) {
    std::optional<std::uint32_t>& between = settings.prepare.between;
    between.reset();
    if (text == "auto") return;
    between = 0;
    if (text == "off") return;
    if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos)
        refuse_value(flag, text, "auto, off or a whole number of " + kBetween.text());
    between = static_cast<std::uint32_t>(parse_count(flag, text, kBetween));
}

void choose_filter(Settings& settings, std::size_t word) {
    constexpr SmoothFilter kFilters[] = {SmoothFilter::kAuto, SmoothFilter::kLattice, SmoothFilter::kTaubin,
                                         SmoothFilter::kLaplacian, SmoothFilter::kNifpms};
    if (word < std::size(kFilters))
        settings.reconstruct.smooth.filter = kFilters[word];
    else
        settings.reconstruct.smooth.passes = 0;
}

}  // namespace

Rows decimation_rows() {
    constexpr std::string_view kGroup = "Decimation";
    return {
        word_option(
            {.name = "for",
             .help = "a set of options, for what nothing else is given. fe, finite elements: --reduce 90% "
                     "--edge-length auto --improve; print: --reduce 80% --smooth-lines --preserve-volume; view: "
                     "--reduce 95% --no-keep-samples",
             .group = kGroup,
             .commands = kReconstruct},
            {"any", "fe", "print", "view"}, [](Settings& s, std::size_t word) { s.purpose = word; }),
        option({.name = "target-faces",
                .is_basic = true,
                .help = "stop when at most this number of faces is left",
                .group = kGroup,
                .commands = kDecimators,
                .unit = "faces"},
               [](Settings& s) { return &s.reconstruct.target_faces; }),
        special_option(
            {.name = "reduce",
             .is_basic = true,
             .help = "stop when this share of the faces is removed, such as 90%; 0 for reconstruct: no decimation",
             .group = kGroup,
             .commands = kDecimators,
             .range = Range{0, 1}.text()},
            OptionKind::kShare,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.reconstruct.reduce = parse_share(flag, text);
            }),
        without_default(option(
            {.name = "max-error",
             .is_basic = true,
             .help = "no point of the model is farther than this from the surface before decimation, nor the other way "
                     "round",
             .group = kGroup,
             .commands = kFinishers,
             .unit = "length"},
            [](Settings& s) { return &s.reconstruct.promises.max_error; })),
        option({.name = "perturbation",
                .help = "largest cost added to rank edges of equal cost, relative to spacing^4",
                .group = kGroup,
                .commands = kDecimators},
               [](Settings& s) { return &s.reconstruct.perturbation; }),
        word_option({.name = "placement",
                     .help = "where a collapse puts the merged vertex: quadric, nearest to the planes of the merged "
                             "faces; lindstrom-turk, keeping all volumes",
                     .group = kGroup,
                     .commands = kDecimators},
                    {kPlacementNames.begin(), kPlacementNames.end()},
                    [](Settings& s, std::size_t word) { s.reconstruct.placement = static_cast<PlacementKind>(word); }),
        inverted_flag({.name = "no-decimate", .help = "do not decimate", .group = kGroup, .commands = kReconstruct},
                      [](Settings& s) { return &s.reconstruct.decimate; }),
    };
}

Rows smoothing_rows() {
    constexpr std::string_view kGroup = "Smoothing";
    return {
        special_option(
            {.name = "smooth",
             .is_basic = true,
             .help = "how much: off, light, normal, strong, or a number of passes (for lattice any is normal); 0: off",
             .group = kGroup,
             .commands = kSmoothers,
             .value = "WORD|PASSES",
             .default_text = "normal"},
            OptionKind::kText, choose_strength),
        word_option(
            {.name = "smooth-filter",
             .help = "lattice (sections only) makes surfaces smooth and keeps every sample; taubin keeps volumes "
                     "roughly, laplacian shrinks, nifpms keeps sharp edges (one pass); auto: lattice for "
                     "sections, else taubin",
             .group = kGroup,
             .commands = kSmoothers},
            {"auto", "lattice", "taubin", "laplacian", "nifpms", "none"}, choose_filter),
        option(
            {.name = "smooth-lambda",
             .help = "share of the way to the mean of the neighbours, for taubin and laplacian",
             .group = kGroup,
             .commands = kSmoothers},
            [](Settings& s) { return &s.reconstruct.smooth.lambda; }, kShareRange),
        special_option(
            {.name = "between",
             .help = "sections to put between each two, from the shapes of their parts, so that far sections make no "
                     "stairs and thin parts no holes. auto: about as many as make the lattice even, where parts do "
                     "not overlap from section to section, else none",
             .group = kGroup,
             .commands = kReconstruct | kCheck,
             .value = "auto|off|N",
             .inputs = kVolumeInput,
             .default_text = "auto"},
            OptionKind::kText, choose_between),
        word_option(
            {.name = "align",
             .help = "move sections in their plane where they lie off the trend of their neighbours, first: by whole "
                     "samples, or turned, too",
             .group = kGroup,
             .commands = kReconstruct | kCheck,
             .inputs = kVolumeInput},
            {"off", "translate", "rigid"},
            [](Settings& s, std::size_t word) { s.prepare.align = static_cast<AlignKind>(word); }),
        option(
            {.name = "room",
             .help = "samples nearer than this to the boundary of their region may change their label first, for noisy "
                     "or enlarged labels; 0: none",
             .group = kGroup,
             .commands = kReconstruct | kCheck,
             .unit = "finest spacings",
             .inputs = kVolumeInput | kTableInput},
            [](Settings& s) { return &s.reconstruct.room; }, kRoom),
        special_option(
            {.name = "denoise",
             .help = "rough labels are made smoother first, with the topology that they have: samples at most "
                     "this far from the boundary of their region may change their label. auto: as far as "
                     "the roughness of the labels asks, not at all where they are clean",
             .group = kGroup,
             .commands = kReconstruct | kCheck,
             .unit = "finest spacings",
             .value = "auto|off|NUMBER",
             .inputs = kVolumeInput | kTableInput,
             .default_text = "auto"},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.reconstruct.denoise.distance = text == "auto"  ? kAutoDenoise
                                                 : text == "off" ? 0
                                                                 : parse_number(flag, text, kDenoise);
            }),
        special_option(
            {.name = "specks",
             .help = "parts of a label of at most this number of samples get the label round them, where the "
                     "label has a part 20 times as large; auto: where there are many",
             .group = kGroup,
             .commands = kReconstruct | kCheck,
             .unit = "samples",
             .value = "auto|off|COUNT",
             .inputs = kVolumeInput | kTableInput,
             .default_text = "auto"},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.reconstruct.denoise.specks = text == "auto" ? kAutoSpecks
                                               : text == "off"
                                                   ? 0
                                                   : static_cast<std::int64_t>(parse_count(flag, text, kSpecks));
            }),
        option({.name = "smooth-points",
                .help = "quadruple points move along their lines, instead of not at all; lattice always moves them",
                .group = kGroup,
                .commands = kSmoothers},
               [](Settings& s) { return &s.reconstruct.smooth.move_points; }),
        option(
            {.name = "scale",
             .help = "sample spacing, the unit of nifpms; the mean edge length if not given",
             .group = kGroup,
             .commands = kSmooth,
             .unit = "length"},
            [](Settings& s) { return &s.scale; }, kLengths),
        option({.name = "preserve-volume",
                .help = "at the end, restore the volume that every region had in the input",
                .group = kGroup,
                .commands = kSmoothers},
               [](Settings& s) { return &s.reconstruct.preserve_volume; }),
    };
}

Rows validity_rows() {
    constexpr std::string_view kGroup = "Quality and crossing";
    return {
        option(
            {.name = "min-quality",
             .help =
                 "lowest quality of the faces that smoothing and decimation make; 0.26 is equilateral. Faces that "
                 "come in below it may stay: a value above 0.14 is no bound of the model. 0.1 if not given; for "
                 "decimation 0.1 times the smallest spacing of the sections over the largest, where it is known and "
                 "unless with --improve or --preserve-volume",
             .group = kGroup,
             .commands = kWriters},
            [](Settings& s) { return &s.reconstruct.promises.min_quality; }, kQualities),
        special_option(
            {.name = "edge-length",
             .is_basic = true,
             .help =
                 "after decimation, split, collapse and flip edges and move vertices until the edges have about this "
                 "length, faces nearly equilateral; auto: that of as many faces as decimation leaves",
             .group = kGroup,
             .commands = kFinishers,
             .unit = "length",
             .value = "auto|NUMBER",
             .range = kLengths.text()},
            OptionKind::kNumber,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.reconstruct.edge_length = text == "auto" ? 0 : parse_number(flag, text, kLengths);
            }),
        option({.name = "smooth-lines",
                .help = "at the end, move the vertices of lines between three regions so that the lines turn less",
                .group = kGroup,
                .commands = kFinishers},
               [](Settings& s) { return &s.reconstruct.smooth_lines; }),
        option({.name = "improve",
                .help = "at the end, flip edges and move vertices so that faces get better, for finite elements",
                .group = kGroup,
                .commands = kFinishers},
               [](Settings& s) { return &s.reconstruct.improve; }),
        inverted_flag({.name = "no-keep-samples",
                       .help = "decimation may carry samples of sections into other regions; more faces can go",
                       .group = kGroup,
                       .commands = kReconstruct,
                       .inputs = kVolumeInput | kTableInput},
                      [](Settings& s) { return &s.reconstruct.keep_samples; }),
        inverted_flag({.name = "no-intersect-check",
                       .help = "no tests for crossing faces while the surface is changed; faster",
                       .group = kGroup,
                       .commands = kReconstruct | kDecimate | kSmooth},
                      [](Settings& s) { return &s.reconstruct.promises.intersect_check; }),
    };
}

Rows comparison_rows() {
    constexpr std::string_view kGroup = "Comparison";
    return {
        option(
            {.name = "samples",
             .help = "number of sample points on each surface",
             .group = kGroup,
             .commands = kCompare},
            [](Settings& s) { return &s.samples; }, kSampleCounts),
        file_option({.name = "distance",
                     .help = ".vtp or .vtu to write: A with the distance of each vertex to B, point array Distance",
                     .group = kGroup,
                     .commands = kCompare,
                     .is_output = true},
                    [](Settings& s) { return &s.distance; }),
    };
}

}  // namespace regionmesh
