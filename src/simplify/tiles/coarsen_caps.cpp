#include "simplify/tiles/coarsen_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel_for.h"
#include "base/triangle.h"
#include "simplify/tuning.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
constexpr int kSidesOfBox = 6;

/// A sample of a side, by its indices along the two axes of the side.
struct Node {
    std::uint32_t u, v;
    bool is_some() const { return u != kNone && v != kNone; }
};

/// An axis of a lattice.
class LatticeAxis {
public:
    LatticeAxis(const Lattice& lattice, int axis)
        : axis_(axis),
          origin_(lattice.origin[axis]),
          spacing_(lattice.spacing[axis]),
          per_unit_(1 / lattice.spacing[axis]) {}

    /// The index of the samples at the position, exactly. kNone between samples.
    std::uint32_t index_at(Vec3 p) const {
        const double index = (p[axis_] - origin_) * per_unit_ + 0.5;
        if (!(index >= 0 && index < 0x1p31)) return kNone;
        const auto found = static_cast<std::uint32_t>(index);
        return origin_ + found * spacing_ == p[axis_] ? found : kNone;
    }
    double along(Vec3 p) const { return p[axis_]; }

private:
    int axis_;
    double origin_, spacing_, per_unit_;
};

/// The vertices of a chunk, as all sides see them.
class ChunkVertices {
public:
    ChunkVertices(const Chunk& chunk, std::span<const ChunkVertex> carried)
        : chunk_(chunk), carried_(carried), is_fixed_(chunk.carried + chunk.vertices.size(), false) {
        for_fixed(chunk, [&](std::uint32_t local) { is_fixed_[local] = true; });
    }
    Vec3 position(std::uint32_t local) const { return vertex_of(chunk_, carried_, local).position; }
    bool is_fixed(std::uint32_t local) const { return is_fixed_[local]; }

private:
    const Chunk& chunk_;
    std::span<const ChunkVertex> carried_;
    std::vector<bool> is_fixed_;
};

/// The faces of a chunk on one side of the box.
class CapSide {
public:
    CapSide(Chunk& chunk, const ChunkVertices& vertices, const Lattice& lattice, int side)
        : chunk_(chunk),
          vertices_(vertices),
          u_axis_(lattice, (side / 2 + 1) % 3),
          v_axis_(lattice, (side / 2 + 2) % 3) {}

    /// Sorts the faces, by number, into the squares of the side, and finds which squares may be joined.
    void find_squares(std::span<const std::uint32_t> faces);

    /// Faces less with squares of up to 2^levels a side.
    std::uint64_t count_removed(int levels) const {
        std::uint64_t removed = 0;
        for_leaves(levels, [&](int level, Node at) {
            const std::uint32_t old = 2u << 2 * level, made = ring_of(level, at).face_count();
            removed += old - std::min(made, old);
        });
        return removed;
    }
    /// Joins them. Faces that are gone get kNone for their first vertex.
    void join(int levels) {
        for_leaves(levels, [&](int level, Node at) { join_square(level, at); });
    }

private:
    /// The vertices of a square of the quadtree that its faces need, counterclockwise seen with u to the right.
    struct Ring {
        std::array<Node, 8> nodes;
        std::uint32_t size = 0;
        Node centre;
        bool has_centre() const { return size > 4; }
        std::uint32_t face_count() const { return has_centre() ? size : 2; }
    };

    Node node_at(std::uint32_t local) const {
        const Vec3 p = vertices_.position(local);
        return {u_axis_.index_at(p), v_axis_.index_at(p)};
    }
    bool add_face(std::uint32_t f);
    void keep_squares_at_fixed_vertices();
    void find_levels();
    Ring ring_of(int level, Node at) const;
    void join_square(int level, Node at);
    bool turns_left(const ChunkFace& face) const;

    /// Level n has a square for every 2^n x 2^n squares.
    std::uint32_t width(int level) const { return width_ >> level; }
    std::uint32_t height(int level) const { return height_ >> level; }
    /// False outside.
    bool is_joined(int level, std::uint32_t i, std::uint32_t j) const {
        return i < width(level) && j < height(level) && joined_[level][std::size_t{j} * width(level) + i] == kPlain;
    }
    std::uint32_t& vertex_at(Node node) { return node_vertex_[std::size_t{node.v} * (width_ + 1) + node.u]; }
    std::size_t square_at(std::uint32_t u, std::uint32_t v) const { return std::size_t{v} * width_ + u; }

    /// Calls visit(level, first node) for each square that is not part of a larger one.
    template <class Visit>
    void for_leaves(int levels, Visit&& visit) const {
        if (joined_.empty()) return;
        for (int level = levels; level > 0; --level)
            for (std::uint32_t j = 0; j < height(level); ++j)
                for (std::uint32_t i = 0; i < width(level); ++i)
                    if (is_joined(level, i, j) && (level == levels || !is_joined(level + 1, i / 2, j / 2)))
                        visit(level, Node{i << level, j << level});
    }

    static constexpr std::uint8_t kPlain = 2;  // faces of a square whose corners are samples

    Chunk& chunk_;
    const ChunkVertices& vertices_;
    LatticeAxis u_axis_, v_axis_;
    Node first_{kNone, kNone};                // the lowest indices that occur, down to a multiple of the largest square
    std::uint32_t width_ = 0, height_ = 0;    // squares
    std::vector<std::uint32_t> node_vertex_;  // by node: its vertex
    std::vector<std::uint32_t> square_faces_;        // two for each square
    std::vector<std::vector<std::uint8_t>> joined_;  // by level and square: kPlain if it may be one; level 0: its faces
};

void CapSide::find_squares(std::span<const std::uint32_t> faces) {
    Node last{0, 0};
    for (const std::uint32_t f : faces)
        for (const std::uint32_t local : chunk_.faces[f].vertices) {
            const Node node = node_at(local);
            if (!node.is_some()) continue;
            first_ = {std::min(first_.u, node.u), std::min(first_.v, node.v)};
            last = {std::max(last.u, node.u), std::max(last.v, node.v)};
        }
    if (first_.u >= last.u || first_.v >= last.v) return;
    constexpr std::uint32_t kLargest = 1u << kCapLevels;
    first_ = {first_.u / kLargest * kLargest, first_.v / kLargest * kLargest};
    width_ = last.u - first_.u;
    height_ = last.v - first_.v;
    node_vertex_.assign(std::size_t{width_ + 1} * (height_ + 1), kNone);
    square_faces_.resize(2 * std::size_t{width_} * height_);
    joined_.resize(kCapLevels + 1);
    joined_[0].assign(std::size_t{width_} * height_, 0);
    for (const std::uint32_t f : faces)
        if (!add_face(f)) return joined_.clear();
    keep_squares_at_fixed_vertices();
    find_levels();
}

/// Notes a face that is half a square. False where two vertices lie at one sample.
bool CapSide::add_face(std::uint32_t f) {
    std::array<Node, 3> corner;
    for (int n = 0; n < 3; ++n) {
        const Node node = node_at(chunk_.faces[f].vertices[n]);
        if (!node.is_some()) return true;
        corner[n] = {node.u - first_.u, node.v - first_.v};
        std::uint32_t& vertex = vertex_at(corner[n]);
        if (vertex != kNone && vertex != chunk_.faces[f].vertices[n]) return false;
        vertex = chunk_.faces[f].vertices[n];
    }
    const auto [low_u, high_u] = std::minmax({corner[0].u, corner[1].u, corner[2].u});
    const auto [low_v, high_v] = std::minmax({corner[0].v, corner[1].v, corner[2].v});
    if (high_u - low_u != 1 || high_v - low_v != 1) return true;
    const std::size_t square = square_at(low_u, low_v);
    std::uint8_t& count = joined_[0][square];
    if (count == kPlain) return false;
    square_faces_[2 * square + count++] = f;
    return true;
}

/// At the edges of the grid all vertices stay.
void CapSide::keep_squares_at_fixed_vertices() {
    for (std::uint32_t v = 1; v < height_; ++v)
        for (std::uint32_t u = 1; u < width_; ++u) {
            const std::uint32_t vertex = vertex_at({u, v});
            if (vertex == kNone || !vertices_.is_fixed(vertex)) continue;
            for (std::uint32_t j = v - 1; j <= v; ++j)
                for (std::uint32_t i = u - 1; i <= u; ++i) joined_[0][square_at(i, j)] = 0;
        }
}

/// A square of a level has four of the level below, and so have its neighbours, from the second level on.
void CapSide::find_levels() {
    for (int level = 1; level <= kCapLevels; ++level) {
        joined_[level].assign(std::size_t{width(level)} * height(level), 0);
        const auto has = [&](std::uint32_t i, std::uint32_t j) { return is_joined(level - 1, i, j); };
        for (std::uint32_t j = 0; j < height(level); ++j)
            for (std::uint32_t i = 0; i < width(level); ++i) {
                const std::uint32_t u = 2 * i, v = 2 * j;
                bool is_one = has(u, v) && has(u + 1, v) && has(u, v + 1) && has(u + 1, v + 1);
                if (is_one && level > 1)
                    for (const std::uint32_t n : {0u, 1u})
                        is_one =
                            is_one && has(u - 1, v + n) && has(u + 2, v + n) && has(u + n, v - 1) && has(u + n, v + 2);
                if (is_one) joined_[level][std::size_t{j} * width(level) + i] = kPlain;
            }
    }
}

/// The corners, and the middle of each side beyond which squares are smaller.
CapSide::Ring CapSide::ring_of(int level, Node at) const {
    const std::uint32_t whole = 1u << level, half = whole / 2, i = at.u >> level, j = at.v >> level;
    Ring ring{.nodes = {}, .size = 0, .centre = {at.u + half, at.v + half}};
    const auto add = [&](std::uint32_t u, std::uint32_t v) { ring.nodes[ring.size++] = {at.u + u, at.v + v}; };
    add(0, 0);
    if (!is_joined(level, i, j - 1)) add(half, 0);
    add(whole, 0);
    if (!is_joined(level, i + 1, j)) add(whole, half);
    add(whole, whole);
    if (!is_joined(level, i, j + 1)) add(half, whole);
    add(0, whole);
    if (!is_joined(level, i - 1, j)) add(0, half);
    return ring;
}

void CapSide::join_square(int level, Node at) {
    const Ring ring = ring_of(level, at);
    const std::uint32_t side = 1u << level;
    if (ring.face_count() >= 2 * side * side) return;
    const ChunkFace old = chunk_.faces[square_faces_[2 * square_at(at.u, at.v)]];
    const bool is_left = turns_left(old);
    const auto face = [&](std::uint32_t n) -> ChunkFace& {
        const std::size_t square = square_at(at.u + n / 2 % side, at.v + n / 2 / side);
        return chunk_.faces[square_faces_[2 * square + n % 2]];
    };
    std::uint32_t made = 0;
    const auto make = [&](Node a, Node b, Node c) {
        if (!is_left) std::swap(b, c);
        face(made++) = {{vertex_at(a), vertex_at(b), vertex_at(c)}, old.labels};
    };
    if (ring.has_centre()) {
        for (std::uint32_t n = 0; n < ring.size; ++n) make(ring.centre, ring.nodes[n], ring.nodes[(n + 1) % ring.size]);
    } else {
        make(ring.nodes[0], ring.nodes[1], ring.nodes[2]);
        make(ring.nodes[0], ring.nodes[2], ring.nodes[3]);
    }
    while (made < 2 * side * side) face(made++).vertices[0] = kNone;
}

/// Seen with u to the right and v up.
bool CapSide::turns_left(const ChunkFace& face) const {
    const Vec3 a = vertices_.position(face.vertices[0]), b = vertices_.position(face.vertices[1]),
               c = vertices_.position(face.vertices[2]);
    const auto u = [&](Vec3 p) { return u_axis_.along(p) - u_axis_.along(a); };
    const auto v = [&](Vec3 p) { return v_axis_.along(p) - v_axis_.along(a); };
    return u(b) * v(c) > v(b) * u(c);
}

/// Would all faces of a side, but for halves of squares, have the quality? They are quarters, by the diagonals.
bool are_good_shapes(const CapOptions& options, int side) {
    const double u = options.lattice.spacing[(side / 2 + 1) % 3], v = options.lattice.spacing[(side / 2 + 2) % 3];
    const Vec3 centre{u / 2, v / 2, 0};
    return face_quality({0, 0, 0}, {u, 0, 0}, centre) >= options.min_quality &&
           face_quality({0, 0, 0}, {0, v, 0}, centre) >= options.min_quality;
}

/// Removes faces without a first vertex, and then vertices without faces; carried and active ones stay.
void compact(Chunk& chunk) {
    std::erase_if(chunk.faces, [](const ChunkFace& face) { return face.vertices[0] == kNone; });
    std::vector<std::uint32_t> number(chunk.carried + chunk.vertices.size(), kNone);
    std::fill(number.begin(), number.begin() + chunk.carried, 0);
    for (const ChunkFace& face : chunk.faces)
        for (const std::uint32_t local : face.vertices) number[local] = 0;
    for (const std::uint32_t local : chunk.active) number[local] = 0;
    std::uint32_t next = 0;
    for (std::uint32_t local = 0; local < number.size(); ++local) {
        if (number[local] == kNone) continue;
        number[local] = next++;
        if (local >= chunk.carried)
            chunk.vertices[number[local] - chunk.carried] = chunk.vertices[local - chunk.carried];
    }
    chunk.vertices.resize(next - chunk.carried);
    for (ChunkFace& face : chunk.faces)
        for (std::uint32_t& local : face.vertices) local = number[local];
    for (std::uint32_t& local : chunk.active) local = number[local];
}

}  // namespace

std::uint64_t most_cap_faces(const Lattice& lattice) {
    const auto cells = [&](int axis) { return std::uint64_t{lattice.size[axis]} - 1; };
    return 4 * (cells(0) * cells(1) + cells(1) * cells(2) + cells(2) * cells(0));
}

std::uint64_t coarsen_caps(Chunk& chunk, std::span<const ChunkVertex> carried, const CapOptions& options) {
    std::array<std::vector<std::uint32_t>, kSidesOfBox> faces;
    for (std::uint32_t f = 0; f < chunk.faces.size(); ++f)
        for (const Label label : chunk.faces[f].labels)
            if (is_exterior(label) && side_of(label) < kSidesOfBox) faces[side_of(label)].push_back(f);
    const ChunkVertices vertices(chunk, carried);
    std::vector<CapSide> sides;
    for (int side = 0; side < kSidesOfBox; ++side) sides.emplace_back(chunk, vertices, options.lattice, side);
    parallel_for(kSidesOfBox, options.threads, [&](std::uint32_t n) {
        if (are_good_shapes(options, static_cast<int>(n))) sides[n].find_squares(faces[n]);
        faces[n] = {};
    });
    for (int levels = kCapLevels; levels > 0; --levels) {
        std::uint64_t removed = 0;
        for (const CapSide& side : sides) removed += side.count_removed(levels);
        if (removed == 0) return 0;
        if (chunk.faces.size() - removed < options.least_faces) continue;
        parallel_for(kSidesOfBox, options.threads, [&](std::uint32_t n) { sides[n].join(levels); });
        compact(chunk);
        return removed;
    }
    return 0;
}

}  // namespace regionmesh
