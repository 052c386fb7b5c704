// Connected parts of the labels of a section, and which of them continue in the next section.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "regionmesh/label.h"
#include "volume/distance_field.h"

namespace regionmesh {

/// Samples of one label that are connected in a section, over sides and corners.
struct SectionPart {
    InputLabel label = 0;
    std::uint64_t samples = 0;
    std::uint64_t sum_x = 0, sum_y = 0;  // of its samples
    SectionBox box = {};
};

/// A section as parts, numbered in the order of their first samples.
struct SectionParts {
    std::int32_t width = 0;
    std::vector<std::uint32_t> number;  // of the part of each sample
    std::vector<SectionPart> parts;
};

SectionParts find_parts(std::span<const InputLabel> section, std::int32_t width);

/// When parts that do not overlap are the same thing: lengths in the unit of the steps.
struct MatchOptions {
    SectionStep step = {};
    float reach = 0;         // largest distance between two parts that overlap nothing
    float branch_reach = 0;  // between a part that overlaps nothing and one that does
};

/// How the parts of two sections belong together. Parts that overlap with others of their label form groups. A part
/// that overlaps none moves to the nearest of a like size, if there is one; else it is a group of its own, which ends
/// between the sections. Two parts that overlap little, no others, and far more after a motion, move as well.
struct PartMatch {
    static constexpr std::uint32_t kMoves = 0xFFFFFFFFu;

    std::uint32_t groups = 0;
    std::uint64_t overlaps = 0;                                  // pairs of parts that overlap
    std::uint64_t apart = 0;                                     // pairs of parts that move, and do not overlap
    std::vector<std::uint32_t> low, high;                        // group of each part; kMoves: none, since it moves
    std::vector<std::pair<std::uint32_t, std::uint32_t>> moves;  // parts of the two sections that are one
};

PartMatch match_parts(const SectionParts& low, const SectionParts& high, const MatchOptions& options);

}  // namespace regionmesh
