#include "smooth/lattice/lattice_simplex.h"

#include <algorithm>
#include <cassert>

namespace regionmesh {

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
