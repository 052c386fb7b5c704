#include "smooth/lattice_lines.h"

#include <algorithm>

namespace regionmesh {
namespace {

/// Keeps vertices between nearly parallel interfaces near the centroid.
constexpr double kRidge = 1e-3;

/// Steps of more edge lengths than this lie far outside the simplex; bounded, sums of weights stay exact enough.
constexpr double kFarthest = 1;

}  // namespace

void NearestPoint::add(const SiteEstimate& estimate, const SimplexEdges& edges) {
    const double unit = 1 / length2(estimate.slope);
    for (int i = 0; i < count; ++i) {
        const double along = unit * dot(estimate.slope, edges.edges[i]);
        for (int j = 0; j < count; ++j) a[i][j] += along * dot(estimate.slope, edges.edges[j]);
        b[i] -= along * estimate.height;
    }
}

void NearestPoint::add(Vec3 target, double weight, const SimplexEdges& edges) {
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) a[i][j] += weight * dot(edges.edges[i], edges.edges[j]);
        b[i] += weight * dot(edges.edges[i], target);
    }
}

std::array<double, 3> NearestPoint::solve() const {
    // By elimination without exchange of rows: the matrix is symmetric and, with the ridge, positive definite.
    auto m = a;
    auto x = b;
    double trace = 0;
    for (int i = 0; i < count; ++i) trace += m[i][i];
    if (!(trace > 0)) return {};
    for (int i = 0; count > 1 && i < count; ++i) m[i][i] += kRidge * trace;
    for (int i = 0; i < count; ++i)
        for (int r = i + 1; r < count; ++r) {
            const double factor = m[r][i] / m[i][i];
            for (int c = i; c < count; ++c) m[r][c] -= factor * m[i][c];
            x[r] -= factor * x[i];
        }
    for (int i = count - 1; i >= 0; --i) {
        for (int c = i + 1; c < count; ++c) x[i] -= m[i][c] * x[c];
        x[i] /= m[i][i];
    }
    return x;
}

Barycentric weights_of(const NearestPoint& nearest) {
    const std::array<double, 3> step = nearest.solve();
    const double equal = 1.0 / (nearest.count + 1);
    Barycentric weights{equal};
    for (int n = 0; n < nearest.count; ++n) {
        const double bounded = std::clamp(step[n], -kFarthest, kFarthest);
        weights[n + 1] = equal + bounded;
        weights[0] -= bounded;
    }
    return weights;
}

LatticeLines::LatticeLines(std::span<const LatticeSimplex> simplices, std::span<const LatticeFace> faces) {
    constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::vector<std::uint32_t> number(simplices.size(), kNone);
    const auto node_of = [&](std::uint32_t vertex) {
        if (number[vertex] == kNone) {
            number[vertex] = static_cast<std::uint32_t>(nodes_.size());
            nodes_.push_back({.vertex = vertex, .centroid = {}});
        }
        return number[vertex];
    };
    const auto join = [&](std::uint32_t from, std::uint32_t to) {
        Node& node = nodes_[from];
        const auto end = node.next.begin() + node.count;
        if (std::find(node.next.begin(), end, to) == end && node.count < 4) node.next[node.count++] = to;
    };
    // Two vertices in triangles or tetrahedra of the lattice are joined along lines only.
    for (const LatticeFace& face : faces)
        for (int n = 0; n < 3; ++n) {
            const std::uint32_t a = face.vertices[n], b = face.vertices[(n + 1) % 3];
            if (simplices[a].kind < kFirstTriangle) continue;
            const std::uint32_t from = node_of(a);
            if (simplices[b].kind < kFirstTriangle) continue;
            const std::uint32_t to = node_of(b);
            join(from, to);
            join(to, from);
        }
}

void LatticeLines::fair(std::span<Vec3> positions, std::span<const LatticeSimplex> simplices, const LatticeFrame& frame,
                        double margin) const {
    std::vector<Vec3> moved(nodes_.size());
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
            const Node& node = nodes_[n];
            Vec3 sum;
            for (int k = 0; k < node.count; ++k) sum += positions[nodes_[node.next[k]].vertex];
            NearestPoint nearest = node.nearest;
            const LatticeSimplex& simplex = simplices[node.vertex];
            if (node.count > 0)
                nearest.add(sum / node.count - node.centroid, kPull, edges_of(simplex.kind, frame.spacing));
            moved[n] = position_in(simplex, clamp_inside(weights_of(nearest), nearest.count + 1, margin), frame);
        }
        for (std::uint32_t n = 0; n < nodes_.size(); ++n) positions[nodes_[n].vertex] = moved[n];
    }
}

}  // namespace regionmesh
