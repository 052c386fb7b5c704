// Rows of the part of a volume to model, in the order in which it is taken.
#include "options/bind_option.h"
#include "options/option_rows.h"
#include "regionmesh/read_sections.h"

namespace regionmesh {

Rows selection_rows() {
    constexpr std::string_view kGroup = "Input";
    constexpr std::uint32_t kLatticeCommands = kVolumeCommands | kVoxelise;
    return {
        special_option(
            {.name = "threshold",
             .is_basic = true,
             .help = "volumes of grey values or shares: label 1 from V on, 0 below; with several values, the "
                     "number of those that a sample reaches",
             .group = kGroup,
             .commands = kVolumeCommands,
             .value = "V[,V...]",
             .inputs = kVolumeInput},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.volume.threshold = parse_thresholds(flag, text);
            }),
        option(
            {.name = "argmax",
             .help = "shares, probabilities or distances, a volume a label, in one file or several: the label of the "
                     "largest; files count from 1, with 0 where none reaches --threshold (0.5)",
             .group = kGroup,
             .commands = kLatticeCommands,
             .inputs = kVolumeInput},
            [](Settings& s) { return &s.volume.argmax; }),
        option(
            {.name = "pitch",
             .help = "contours: distance of samples in a section; without it, from the lengths of their edges",
             .group = kGroup,
             .commands = kLatticeCommands,
             .unit = "length",
             .inputs = kVolumeInput},
            [](Settings& s) { return &s.volume.pitch; }, Range{.low = 0, .is_low_included = false}),
        special_option(
            {.name = "priority",
             .help = "masks and segments: names or labels that win where regions overlap, the first over all "
                     "others; without it, the last in the file or in the list",
             .group = kGroup,
             .commands = kVolumeCommands,
             .value = "NAMES",
             .inputs = kVolumeInput},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.volume.priority = parse_names(flag, text);
            }),
        special_option(
            {.name = "roi",
             .help = "volumes: samples to keep along x, y and z, as 10:50,:,20: (from 10 to 49, all, from 20)",
             .group = kGroup,
             .commands = kLatticeCommands,
             .unit = "samples",
             .value = "X,Y,Z",
             .inputs = kVolumeInput},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.volume.select.roi = parse_sample_ranges(flag, text);
            }),
        special_option({.name = "box",
                        .help = "volumes: keep the samples with these coordinates, as 0:120.5,:,-20:35; layers: their "
                                "extent",
                        .group = kGroup,
                        .commands = kLatticeCommands,
                        .unit = "length",
                        .value = "X,Y,Z",
                        .inputs = kVolumeInput | kTableInput},
                       OptionKind::kText,
                       [](Settings& s, const std::string& flag, const std::string& text) {
                           s.volume.select.box = parse_length_ranges(flag, text);
                       }),
        special_option({.name = "merge",
                        .help = "volumes: table of labels to join, with rows old,new or old,new,name; old may be 5-9",
                        .group = kGroup,
                        .commands = kVolumeCommands,
                        .inputs = kVolumeInput},
                       OptionKind::kFile,
                       [](Settings& s, const std::string&, const std::string& text) { s.volume.merge_table = text; }),
        special_option({.name = "labels",
                        .is_basic = true,
                        .help = "volumes: labels to keep, as 1,5-9; samples with another label become background",
                        .group = kGroup,
                        .commands = kVolumeCommands,
                        .value = "LABELS",
                        .inputs = kVolumeInput},
                       OptionKind::kText,
                       [](Settings& s, const std::string& flag, const std::string& text) {
                           s.volume.select.labels = parse_label_ranges(flag, text);
                       }),
        special_option(
            {.name = "downsample",
             .help = "volumes: samples along each axis that become one, as 2 or 2,2,1; the most frequent label",
             .group = kGroup,
             .commands = kLatticeCommands,
             .unit = "samples",
             .value = "N|X,Y,Z",
             .inputs = kVolumeInput},
            OptionKind::kText,
            [](Settings& s, const std::string& flag, const std::string& text) {
                s.volume.select.downsample = parse_factors(flag, text);
            }),
        option({.name = "min-region",
                .help = "volumes: a connected region of fewer samples gets the label with which it has most interface",
                .group = kGroup,
                .commands = kVolumeCommands,
                .unit = "samples",
                .inputs = kVolumeInput},
               [](Settings& s) { return &s.volume.select.min_region; }),
    };
}

}  // namespace regionmesh
