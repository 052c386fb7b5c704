#include "smooth/lattice/lattice_simplex.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

/// Positions are rounded: far from the origin of the lattice by more than a unit in the last place.
constexpr double kFarFromTwelfth = 0.01;

/// In twelfths; no volume is that large.
constexpr double kFarthest = 1e15;

/// The kind by the twelfths of the spacings from the base node to the centroid, the first axis fastest.
constexpr std::uint8_t kNoKind = 255;
constexpr std::array<std::uint8_t, 12 * 12 * 12> kKindOfTwelfths = [] {
    std::array<std::uint8_t, 12 * 12 * 12> kinds{};
    for (std::uint8_t& kind : kinds) kind = kNoKind;
    for (int kind = 0; kind < kKindCount; ++kind) {
        const Vec3 middle = centroid(kind);
        const auto twelfths = [](double offset) { return static_cast<int>(12 * offset + 0.5); };
        kinds[(twelfths(middle.z) * 12 + twelfths(middle.y)) * 12 + twelfths(middle.x)] =
            static_cast<std::uint8_t>(kind);
    }
    return kinds;
}();

[[noreturn]] void refuse(Vec3 p) {
    throw Error(ErrorCode::kInput, "smoothing in the lattice: the vertex at " + std::to_string(p.x) + ", " +
                                       std::to_string(p.y) + ", " + std::to_string(p.z) +
                                       " is not the centroid of a lattice simplex; only an unsmoothed, undecimated "
                                       "reconstruction of sections can be smoothed so");
}

}  // namespace

LatticeSimplex simplex_of(Vec3 position, const LatticeFrame& frame) {
    // A centroid's offsets are multiples of 1/2, 1/3 or 1/4: of 1/12. Offset times node_count is the number of nodes
    // that have the axis, which gives the chain of steps.
    LatticeSimplex simplex;
    std::array<int, 3> twelfths;
    for (int axis = 0; axis < 3; ++axis) {
        const double offset = 12 * ((position[axis] - frame.origin[axis]) / frame.spacing[axis]);
        if (!(offset > -0.5 && offset < kFarthest)) refuse(position);
        const auto scaled = static_cast<std::uint64_t>(offset + 0.5);
        if (!(std::abs(offset - static_cast<double>(scaled)) < kFarFromTwelfth)) refuse(position);
        simplex.base[axis] = static_cast<double>(scaled / 12);
        twelfths[axis] = static_cast<int>(scaled % 12);
    }
    const std::uint8_t kind = kKindOfTwelfths[(twelfths[2] * 12 + twelfths[1]) * 12 + twelfths[0]];
    if (kind == kNoKind) refuse(position);
    simplex.kind = kind;
    return simplex;
}

Barycentric clamp_inside(const Barycentric& weights, int node_count, double margin) {
    assert(margin * node_count < 1);
    Barycentric inside{};
    double room = 0;
    for (int n = 0; n < node_count; ++n) room += inside[n] = std::max(weights[n] - margin, 0.0);
    const double share = (1 - node_count * margin) / room;
    for (int n = 0; n < node_count; ++n) inside[n] = margin + share * inside[n];
    return inside;
}

/// Weights are rounded, not sums of them: axes with the same nodes get the same offset, bit for bit.
FixedWeights rounded(const Barycentric& weights, int node_count) {
    FixedWeights fixed{};
    for (int n = 1; n < node_count; ++n) fixed[n - 1] = static_cast<std::uint32_t>(weights[n] * kWeightUnit + 0.5);
    return fixed;
}

Vec3 position_in(const LatticeSimplex& simplex, const FixedWeights& weights, const LatticeFrame& frame) {
    const SimplexKind& kind = kKinds[simplex.kind];
    Vec3 offset;
    for (int n = 1; n < kind.node_count; ++n) {
        const double weight = weights[n - 1] / kWeightUnit;
        for (int axis = 0; axis < 3; ++axis)
            if (kind.steps[n] >> axis & 1) offset[axis] += weight;
    }
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = frame.at(axis, simplex.base[axis] + offset[axis]);
    return position;
}

SimplexEdges edges_of(int kind, Vec3 spacing) {
    SimplexEdges result{kKinds[kind].node_count - 1, {}};
    for (int n = 0; n < result.count; ++n)
        for (int axis = 0; axis < 3; ++axis)
            if (kKinds[kind].steps[n + 1] >> axis & 1) result.edges[n][axis] = spacing[axis];
    return result;
}

}  // namespace regionmesh
