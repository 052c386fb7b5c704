#include "smooth/lattice_lines.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel_for.h"

namespace regionmesh {
namespace {

/// Keeps vertices between nearly parallel interfaces near the centroid.
constexpr double kRidge = 1e-3;

/// Steps of more edge lengths than this lie far outside the simplex; bounded, sums of weights stay exact enough.
constexpr double kFarthest = 1;

}  // namespace

void NearestPoint::add(const SiteEstimate& estimate, const SimplexEdges& edges) {
    const Vec3 slope = estimate.slope.wide();
    const double unit = 1 / length2(slope);
    for (int i = 0; i < count; ++i) {
        const double along = unit * dot(slope, edges.edges[i]);
        for (int j = 0; j < count; ++j) a[i][j] += along * dot(slope, edges.edges[j]);
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

std::array<std::array<double, 3>, 3> NearestPoint::inverse() const {
    std::array<std::array<double, 3>, 3> columns{};
    for (int n = 0; n < count; ++n) {
        NearestPoint unit{count, a, {}};
        unit.b[n] = 1;
        columns[n] = unit.solve();
    }
    return columns;  // symmetric
}

Barycentric weights_of(const std::array<double, 3>& step, int count) {
    const double equal = 1.0 / (count + 1);
    Barycentric weights{equal, 0, 0, 0};
    for (int n = 0; n < count; ++n) {
        const double bounded = std::clamp(step[n], -kFarthest, kFarthest);
        weights[n + 1] = equal + bounded;
        weights[0] -= bounded;
    }
    return weights;
}

void LatticeLines::add(const LatticeSimplex& simplex, const NearestPoint& to_interfaces, Vec3 position) {
    std::array<std::uint32_t, 3> base;
    for (int axis = 0; axis < 3; ++axis) base[axis] = static_cast<std::uint32_t>(simplex.base[axis]);
    nodes_.push_back({base, simplex.kind, 0, {}, terms_.end(), {position, position}});
    const int count = to_interfaces.count;
    for (int i = 0; i < count; ++i) terms_.push_back(to_interfaces.b[i]);
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) terms_.push_back(to_interfaces.a[i][j]);
}

/// The sides of faces of a chunk, from its nodes and those of the chunk before.
void LatticeLines::find_sides(std::uint32_t chunk, const PackedChunks::Parts& parts) {
    const std::uint32_t first = first_node_[chunk];
    std::vector<std::uint32_t> nodes = std::move(carried_);
    std::uint32_t next = first;
    for (const LatticeVertex& vertex : parts.vertices) nodes.push_back(has(vertex.simplex) ? next++ : kNoNode);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::array<Label, 2> labels) {
        if (labels[0] > labels[1]) std::swap(labels[0], labels[1]);
        std::vector<Side>& sides = a < first ? sides_ : next_sides_;
        sides.push_back({a, b, static_cast<std::uint32_t>(sides.size()), labels});
    };
    for (const auto& [v, labels] : parts.faces) {
        const std::uint32_t corners[3] = {nodes[v[0]], nodes[v[1]], nodes[v[2]]};
        for (int n = 0; n < 3; ++n) {
            const std::uint32_t a = corners[n], b = corners[(n + 1) % 3];
            if (a == kNoNode || b == kNoNode) continue;
            add(a, b, labels);
            add(b, a, labels);
        }
    }
    carried_.clear();
    for (const std::uint32_t local : parts.active) carried_.push_back(nodes[local]);
}

/// An edge between two vertices in triangles or tetrahedra of the lattice is part of a line where faces of two
/// interfaces meet in it; compact cells cut sheets along such edges, too.
void LatticeLines::link(std::uint32_t chunk, const PackedChunks& chunks, PackedChunks::Parts& parts) {
    const NumberRange own{first_node_[chunk], first_node_[chunk + 1]};
    if (chunk == 0) {
        chunks.unpack(0, parts);
        find_sides(0, parts);
    }
    std::vector<Side>& sides = sides_;
    sides.swap(next_sides_);
    next_sides_.clear();
    if (chunk + 1 < chunks.end()) {
        chunks.unpack(chunk + 1, parts);
        find_sides(chunk + 1, parts);
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.from, a.to, a.order) < std::tie(b.from, b.to, b.order);
    });
    // One side for each edge of a line, in the order in which they came.
    std::size_t kept = 0;
    for (std::size_t first = 0, end; first < sides.size(); first = end) {
        bool is_line = false;
        for (end = first;
             end < sides.size() && sides[end].from == sides[first].from && sides[end].to == sides[first].to; ++end)
            is_line |= sides[end].labels != sides[first].labels;
        if (is_line) sides[kept++] = sides[first];
    }
    sides.resize(kept);
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.order < b.order; });
    for (const Side& side : sides) {
        Node& node = nodes_[side.from];
        if (node.count < node.next.size()) node.next[node.count++] = side.to;
    }
    for (std::uint32_t n = own.first; n < own.end; ++n) end_links(nodes_[n]);
}

/// The pull of the neighbours has the same matrix in all sweeps.
void LatticeLines::end_links(Node& node) {
    const int count = node.edge_count();
    NearestPoint nearest{count};
    std::uint32_t term = node.first_term + count;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) nearest.a[i][j] = terms_[term++];
    if (node.count > 0) nearest.add({0, 0, 0}, kPull, edges_of(node.kind, frame_.spacing / frame_.finest()));
    const auto inverse = nearest.inverse();
    term = node.first_term + count;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) terms_[term++] = inverse[i][j];
}

/// What nodes of a kind share.
struct LatticeLines::SweepTables {
    double finest;
    std::array<SimplexEdges, kKindCount> edges;
    std::array<std::array<Vec3, 3>, kKindCount> steps;  // in lattice units

    explicit SweepTables(const LatticeFrame& frame) : finest(frame.finest()) {
        for (int kind = kFirstTriangle; kind < kKindCount; ++kind) {
            edges[kind] = edges_of(kind, frame.spacing / finest);
            steps[kind] = edges_of(kind, {1, 1, 1}).edges;
        }
    }
};

template <int kEdges>
void LatticeLines::sweep_node(Node& node, std::uint32_t from, const SweepTables& tables) {
    std::array<double, kEdges> b;
    std::array<std::array<double, kEdges>, kEdges> a;
    std::uint32_t term = node.first_term;
    for (double& number : b) number = terms_[term++];
    for (auto& row : a)
        for (double& number : row) number = terms_[term++];
    const LatticeSimplex simplex = node.simplex();
    if (node.count > 0) {
        Vec3 sum;
        for (std::uint32_t k = 0; k < node.count; ++k) sum += nodes_[node.next[k]].at[from];
        const Vec3 target = (sum / node.count - centroid_in(simplex, frame_)) / tables.finest;
        for (int i = 0; i < kEdges; ++i) b[i] += kPull * dot(tables.edges[node.kind].edges[i], target);
    }
    std::array<double, 3> step{};
    for (int i = 0; i < kEdges; ++i)
        for (int j = 0; j < kEdges; ++j) step[i] += a[i][j] * b[j];
    const FixedWeights weights =
        rounded(clamp_inside(weights_of(step, kEdges), kEdges + 1, margins_.of(node.kind)), kEdges + 1);
    node.at[1 - from] = position_in(simplex, weights, frame_);
}

void LatticeLines::sweep(std::uint32_t number, std::uint32_t chunk, std::uint32_t threads) {
    constexpr std::uint32_t kTask = 256;  // nodes
    const std::uint32_t first = first_node_[chunk], end = first_node_[chunk + 1], from = number % 2;
    const SweepTables tables(frame_);
    parallel_for((end - first + kTask - 1) / kTask, threads, [&](std::uint32_t task) {
        const std::uint32_t task_end = std::min(end, first + (task + 1) * kTask);
        for (std::uint32_t n = first + task * kTask; n < task_end; ++n) {
            Node& node = nodes_[n];
            if (node.edge_count() == 2)
                sweep_node<2>(node, from, tables);
            else
                sweep_node<3>(node, from, tables);
        }
    });
}

void LatticeLines::drop_before(std::uint32_t chunk) {
    const std::uint32_t first = first_node_[chunk];
    terms_.drop_before(first < nodes_.end() ? nodes_[first].first_term : terms_.end());
    nodes_.drop_before(first);
    first_node_.drop_before(chunk);
}

}  // namespace regionmesh
