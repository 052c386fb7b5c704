// Whether a sample may change its label without a change of topology: a test on its neighbours in Kuhn's lattice.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "regionmesh/label.h"

namespace regionmesh {

/// The neighbours of a node of Kuhn's lattice are the nodes of its link, a sphere of 24 triangles: seven steps with
/// coordinates 0 and 1, and their opposites.
inline constexpr int kLinkSize = 14;
struct LinkStep {
    int i, j, k;
};
inline constexpr std::array<LinkStep, kLinkSize> kLinkSteps = [] {
    std::array<LinkStep, kLinkSize> steps{};
    for (int n = 1; n < 8; ++n) {
        steps[n - 1] = {n & 1, n >> 1 & 1, n >> 2};
        steps[n + 6] = {-(n & 1), -(n >> 1 & 1), -(n >> 2)};
    }
    return steps;
}();

/// Nodes of the link: bit n stands for kLinkSteps[n].
using LinkSet = std::uint16_t;

/// Does the full subcomplex on these nodes contract to a point? On a sphere: if it and the rest are connected, and
/// neither is empty.
bool is_contractible(LinkSet nodes);

/// The connected parts of these nodes.
struct LinkParts {
    int count = 0;
    std::array<LinkSet, kLinkSize> parts{};
};
LinkParts parts_of(LinkSet nodes);

/// Labels of the link; kOutside beyond the volume, which counts as a region.
using LinkLabels = std::array<Label, kLinkSize>;
inline constexpr Label kOutside = 0xFFFFFFFFu;

/// May the node in the middle go from one label to the other? True if this changes the homotopy type of no union of
/// regions. So the Euler characteristics, parts and cavities of regions, the pairs of regions with an interface, and
/// the numbers of quadruple points stay. False, too, with more than kMostOthers other labels in the link.
inline constexpr int kMostOthers = 6;
bool is_simple(const LinkLabels& link, Label from, Label to);

}  // namespace regionmesh
