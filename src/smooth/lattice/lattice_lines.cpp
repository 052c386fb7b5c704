#include "smooth/lattice/lattice_lines.h"

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

constexpr Unsigned4 axes_of(unsigned step) {
    const auto mask = [&](int axis) { return (step >> axis & 1) != 0 ? ~0u : 0; };
    return Unsigned4{mask(0), mask(1), mask(2), 0};
}

/// By kind and by node of a simplex but the first: the axes along which it lies beyond the first.
constexpr std::array<std::array<Unsigned4, 3>, kKindCount> kAxes = [] {
    std::array<std::array<Unsigned4, 3>, kKindCount> axes{};
    for (int kind = 0; kind < kKindCount; ++kind)
        for (int n = 1; n < kKinds[kind].node_count; ++n) axes[kind][n - 1] = axes_of(kKinds[kind].steps[n]);
    return axes;
}();

/// The point of a simplex with the given first node and weights of the others, all in fixed point.
Unsigned4 point_at(Unsigned4 base, int kind, Unsigned4 weights) {
    const auto& axes = kAxes[kind];
    return base + (__builtin_shufflevector(weights, weights, 0, 0, 0, 0) & axes[0]) +
           (__builtin_shufflevector(weights, weights, 1, 1, 1, 1) & axes[1]) +
           (__builtin_shufflevector(weights, weights, 2, 2, 2, 2) & axes[2]);
}

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

void LatticeLines::add(const LatticeSimplex& simplex, const NearestPoint& to_interfaces, const FixedWeights& weights) {
    const std::uint32_t node = at_[0].end(), lane = node % 4;
    if (lane == 0) fours_.push_back({});
    Four& four = fours_[node / 4];
    for (int axis = 0; axis < 3; ++axis) four.base[lane][axis] = static_cast<std::uint32_t>(simplex.base[axis]);
    four.kind[lane] = simplex.kind;
    equations_.push_back(to_interfaces);
    const Unsigned4 at = point_at(load<Unsigned4>(&four.base[lane]) << kWeightBits, simplex.kind,
                                  Unsigned4{weights[0], weights[1], weights[2], 0});
    for (SlidingArray<Unsigned4>& side : at_) side.push_back(at);
}

/// Chunks begin with a new four.
void LatticeLines::end_chunk() {
    while (at_[0].end() % 4 != 0) {
        equations_.push_back({});
        for (SlidingArray<Unsigned4>& side : at_) side.push_back(Unsigned4{});
    }
    first_node_.push_back(at_[0].end());
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
        Four& four = fours_[side.from / 4];
        auto& next = four.next[side.from % 4];
        std::uint8_t& count = four.count[side.from % 4];
        if (count < next.size()) next[count++] = side.to;
    }
    for (std::uint32_t node = own.first; node < own.end; ++node) end_links(node);
    equations_.drop_before(own.end);
}

/// The least squares of a node, solved for any sum of its neighbours.
void LatticeLines::end_links(std::uint32_t node) {
    Four& four = fours_[node / 4];
    const std::uint32_t lane = node % 4;
    const NearestPoint& to_interfaces = equations_[node];
    const int kind = four.kind[lane], edge_count = to_interfaces.count, neighbours = four.count[lane];
    if (edge_count == 0) return;  // there is no node
    const Vec3 spacing = frame_.spacing / frame_.finest();
    const SimplexEdges edges = edges_of(kind, spacing);
    NearestPoint nearest = to_interfaces;
    // The neighbours are summed from the base, which lies here from the centroid.
    const Vec3 middle = kCentroids[kind], base{-middle.x * spacing.x, -middle.y * spacing.y, -middle.z * spacing.z};
    if (neighbours > 0) nearest.add(base, kPull, edges);
    const std::array<double, 3> step = nearest.solve();
    const auto inverse = nearest.inverse();
    for (int i = 0; i < edge_count; ++i) {
        four.step[i][lane] = static_cast<float>(step[i]);
        if (neighbours == 0) continue;
        Vec3 pull;
        for (int j = 0; j < edge_count; ++j) pull += inverse[i][j] * kPull * edges.edges[j];
        for (int axis = 0; axis < 3; ++axis)
            four.pull[i][axis][lane] = static_cast<float>(pull[axis] * spacing[axis] / neighbours / kWeightUnit);
    }
    const double margin = margins_.of(kind), inset = 1.0 / (edge_count + 1) - margin;
    four.margin[lane] = static_cast<float>(margin);
    four.inset[lane] = static_cast<float>(inset);
    four.inset_third[lane] = edge_count == 3 ? four.inset[lane] : 0;
    four.room[lane] = static_cast<float>(1 - (edge_count + 1) * margin);
}

/// `before` begins with the node `first`, `after` with the first of these.
void LatticeLines::Four::sweep(const Unsigned4* before, std::uint32_t first, Unsigned4* after) const {
    std::array<Unsigned4, 4> base_at;
    std::array<Float4, 4> sums;  // sums of the neighbours, from the base
    for (int lane = 0; lane < 4; ++lane) {
        base_at[lane] = load<Unsigned4>(&base[lane]) << kWeightBits;
        Unsigned4 sum{};
        for (std::uint32_t k = 0; k < count[lane]; ++k) sum += before[next[lane][k] - first] - base_at[lane];
        sums[lane] = __builtin_convertvector(reinterpret_cast<Lane4>(sum), Float4);
    }
    const auto axes = transposed(sums[0], sums[1], sums[2], sums[3]);
    const Float4 farthest = all_four(kFarthest), unit = all_four(kWeightUnit), none{};
    std::array<Float4, 3> weights;
    Float4 first_weight = inset;
    for (int i = 0; i < 3; ++i) {
        const Float4 pulled = step[i] + pull[i][0] * axes[0] + pull[i][1] * axes[1] + pull[i][2] * axes[2];
        weights[i] = greatest(least(pulled, farthest), -farthest);
        first_weight -= weights[i];
    }
    // As in clamp_inside().
    Float4 sum = greatest(first_weight, none);
    for (int i = 0; i < 3; ++i) {
        weights[i] = greatest(weights[i] + (i < 2 ? inset : inset_third), none);
        sum += weights[i];
    }
    const Float4 share = room / sum;
    std::array<Unsigned4, 3> fixed;
    for (int i = 0; i < 3; ++i)
        fixed[i] =
            reinterpret_cast<Unsigned4>(__builtin_convertvector((margin + share * weights[i]) * unit + 0.5f, Lane4));
    const auto by_node = transposed(fixed[0], fixed[1], fixed[2], Unsigned4{});
    for (int lane = 0; lane < 4; ++lane) after[lane] = point_at(base_at[lane], kind[lane], by_node[lane]);
}

void LatticeLines::sweep(std::uint32_t number, std::uint32_t chunk, std::uint32_t threads) {
    constexpr std::uint32_t kTask = 256;  // fours
    const std::uint32_t first = at_[0].first(), begin = first_node_[chunk] / 4, end = first_node_[chunk + 1] / 4;
    if (begin == end) return;
    const Unsigned4* before = &at_[number % 2][first];
    Unsigned4* after = &at_[1 - number % 2][first];
    for_each_index(end - begin, kTask, threads,
                   [&](std::uint32_t n) { fours_[begin + n].sweep(before, first, after + (4 * (begin + n) - first)); });
}

Vec3 LatticeLines::position(std::uint32_t node) const {
    const auto& base = fours_[node / 4].base[node % 4];
    const Unsigned4 offset = at_[0][node] - (load<Unsigned4>(&base) << kWeightBits);
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = frame_.at(axis, base[axis] + offset[axis] / kWeightUnit);
    return position;
}

void LatticeLines::drop_before(std::uint32_t chunk) {
    const std::uint32_t first = first_node_[chunk];
    fours_.drop_before(first / 4);
    for (SlidingArray<Unsigned4>& side : at_) side.drop_before(first);
    first_node_.drop_before(chunk);
}

}  // namespace regionmesh
