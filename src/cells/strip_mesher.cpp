#include "cells/strip_mesher.h"

#include <algorithm>
#include <cassert>

namespace regionmesh {
namespace {

constexpr Step kAlongSweep = 4;

/// Slot of a kind among those in the plane of a section, or among the others.
constexpr int slot_of(int kind) {
    const bool in_plane = !(extent(kind) & kAlongSweep);
    int slot = 0;
    for (int k = 0; k < kind; ++k) slot += (!(extent(k) & kAlongSweep)) == in_plane;
    return slot;
}

/// The kinds along the axes of the lattice, by those along the axes of the sweep.
std::array<std::uint8_t, kKindCount> kinds_in_lattice(const Sweep& sweep) {
    std::array<std::uint8_t, kKindCount> kinds{};
    for (int kind = 0; kind < kKindCount; ++kind) {
        std::array<Step, 4> steps{};
        for (int n = 1; n < kKinds[kind].node_count; ++n)
            for (int a = 0; a < 3; ++a)
                if (kKinds[kind].steps[n] >> a & 1) steps[n] |= 1 << sweep.axes[a];
        kinds[kind] = static_cast<std::uint8_t>(kind_of(steps[1], steps[2], steps[3]));
    }
    return kinds;
}

}  // namespace

StripMesher::StripMesher(const Lattice& lattice, Sweep sweep, StripOptions options)
    : lattice_(lattice),
      sweep_(sweep),
      lattice_kinds_(kinds_in_lattice(sweep)),
      options_(std::move(options)),
      width_(lattice.size[sweep.axes[0]]),
      height_(lattice.size[sweep.axes[1]]),
      count_(lattice.size[sweep.axes[2]]),
      mixed_(width_ - 1) {
    assert(width_ >= 2 && height_ >= 2 && count_ >= 2);
    const std::size_t samples = std::size_t{width_} * height_;
    for (auto& plane : planes_) plane.assign(samples * kPlaneSlots, 0);
    for (auto& row : rows_) row.assign(std::size_t{width_} * kRowSlots, 0);
    plan_tetrahedra();
    plan_triangles();
    if (options_.cells == CellKind::kCompact) compact_cells_ = &CompactCells::get();
    plan_compact_cells();
}

std::size_t StripMesher::bytes() const {
    return 4 * (planes_[0].size() + planes_[1].size() + rows_[0].size() + rows_[1].size() + touched_[0].capacity() +
                touched_[1].capacity());
}

/// The simplex spanned by some corners (steps from the cell's first node, in increasing order).
StripMesher::SimplexPlace StripMesher::place_of(const Step* corners, unsigned set) const {
    Step base = -1;
    std::array<Step, 3> chain{0, 0, 0};
    int length = 0;
    for (int c = 0; c < 4; ++c) {
        if (!(set >> c & 1)) continue;
        if (base < 0)
            base = corners[c];
        else
            chain[length++] = corners[c] - base;
    }
    const int kind = kind_of(chain[0], chain[1], chain[2]);
    assert(kind >= 0);
    const std::uint32_t dx = base & 1, dy = base >> 1 & 1;
    SimplexPlace place{Table::kNowhere, std::uint8_t(kind), base, 0};
    if (kind >= kFirstTetrahedron) return place;
    const std::uint32_t slot = slot_of(kind);
    if (!(extent(kind) & kAlongSweep)) {
        place.table = base & kAlongSweep ? Table::kHighPlane : Table::kLowPlane;
        place.offset = (dy * width_ + dx) * kPlaneSlots + slot;
    } else {
        place.table = dy ? Table::kNextRow : Table::kRow;
        place.offset = dx * kRowSlots + slot;
    }
    return place;
}

void StripMesher::plan_tetrahedra() {
    for (int t = 0; t < 6; ++t) {
        TetrahedronPlan& plan = tetrahedra_[t];
        plan.corners = kKinds[kFirstTetrahedron + t].steps;
        plan.cases = make_tetrahedron_cases(plan.corners, options_.cuts);
        for (unsigned set = 1; set < 16; ++set) plan.simplices[set] = place_of(plan.corners.data(), set);
    }
}

void StripMesher::plan_triangles() {
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const bool is_high = side % 2;
        const Step across = 1 << axis;
        for (int first = 0; first < 3; ++first) {
            if (first == axis) continue;
            const int second = 3 - axis - first;
            // Steps from the corner of the cell's square, along one axis of the side, then along both.
            const Step base = is_high ? across : 0;
            std::array<Step, 3> increasing{base, base | 1 << first, base | 1 << first | 1 << second};
            TrianglePlan plan{.corners = increasing, .simplices = {}, .cases = {}};
            // e_first x (e_first + e_second) points along +axis when (first, second, axis) is cyclic.
            const bool points_high = (first + 1) % 3 == second;
            const bool turn = points_high != is_high;
            if (turn) std::swap(plan.corners[1], plan.corners[2]);
            plan.cases = make_triangle_cases(plan.corners, options_.cuts);
            for (unsigned set = 1; set < 8; ++set) {
                unsigned sorted = set;
                if (turn) sorted = (set & 1) | (set >> 2 & 1) << 1 | (set >> 1 & 1) << 2;
                plan.simplices[set] = place_of(increasing.data(), sorted);
            }
            triangles_[side].push_back(std::move(plan));
        }
    }
}

void StripMesher::plan_compact_cells() {
    for (int n = 0; n < kCellSimplexCount; ++n) {
        std::array<Step, 4> corners{};
        int count = 0;
        for (Step step = 0; step < 8; ++step)
            if (kCellSimplices[n] >> step & 1) corners[count++] = step;
        simplices_[n] = place_of(corners.data(), (1u << count) - 1);
    }
    for (int side = 0; side < 6; ++side) {
        SquarePlan& plan = squares_[side];
        plan.corners = corners_of_side(side);
        plan.turns = side % 2 == 0;
        for (const auto& faces : kCompactCaps)
            for (const CaseFace& face : faces)
                for (CornerSet set : face.vertices) plan.simplices[set] = place_of(plan.corners.data(), set);
    }
}

void StripMesher::mesh(std::span<const Label> low, std::span<const Label> high, Chunk& chunk) {
    assert(strip_ + 1 < count_ && low.size() == std::size_t{width_} * height_ && high.size() == low.size());
    low_ = low;
    high_ = high;
    chunk_ = &chunk;
    chunk.carried = static_cast<std::uint32_t>(touched_[0].size());
    std::fill(rows_[0].begin(), rows_[0].end(), 0);
    for (std::uint32_t j = 0; j + 1 < height_; ++j) {
        std::fill(rows_[1].begin(), rows_[1].end(), 0);
        mesh_row(j);
        roll_rows();
    }
    roll_planes();
    ++strip_;
}

void StripMesher::mesh_row(std::uint32_t j) {
    const std::size_t row = std::size_t{j} * width_;
    const std::uint32_t cells = width_ - 1;
    mixed_.find(&low_[row], &low_[row + width_], &high_[row], &high_[row + width_]);
    const bool is_compact = options_.cells == CellKind::kCompact;
    mixed_.for_each([&](std::uint32_t i) { is_compact ? mesh_compact(i, j) : mesh_in_tetrahedra(i, j); });
    if (!options_.cap) return;
    cap_side(0, j, 0);
    cap_side(cells - 1, j, 1);
    for (std::uint32_t i = 0; i < cells; ++i) {
        if (j == 0) cap_side(i, j, 2);
        if (j + 2 == height_) cap_side(i, j, 3);
        if (strip_ == 0) cap_side(i, j, 4);
        if (strip_ + 2 == count_) cap_side(i, j, 5);
    }
}

std::array<Label, 8> StripMesher::cell_labels(std::uint32_t i, std::uint32_t j) const {
    const std::size_t a = std::size_t{j} * width_ + i, b = a + width_;
    return {low_[a], low_[a + 1], low_[b], low_[b + 1], high_[a], high_[a + 1], high_[b], high_[b + 1]};
}

void StripMesher::mesh_in_tetrahedra(std::uint32_t i, std::uint32_t j) {
    const auto labels = cell_labels(i, j);
    for (const TetrahedronPlan& plan : tetrahedra_) {
        const std::array<Label, 4> corner{labels[0], labels[plan.corners[1]], labels[plan.corners[2]], labels[7]};
        const unsigned pattern = tetrahedron_pattern(corner[0], corner[1], corner[2], corner[3]);
        if (!pattern) continue;
        std::array<std::uint32_t, 16> known{};  // vertex number + 1 by CornerSet
        for (const CaseFace& face : plan.cases[pattern]) {
            ChunkFace made;
            for (int n = 0; n < 3; ++n) {
                std::uint32_t& number = known[face.vertices[n]];
                if (!number) number = vertex(plan.simplices[face.vertices[n]], i, j) + 1;
                made.vertices[n] = number - 1;
            }
            made.labels = {corner[face.first], corner[face.second]};
            chunk_->faces.push_back(made);
        }
    }
}

void StripMesher::mesh_compact(std::uint32_t i, std::uint32_t j) {
    const auto labels = cell_labels(i, j);
    std::array<std::uint32_t, kCellSimplexCount> known{};  // vertex number + 1
    compact_cells_->for_each_face(labels, [&](const CompactFace& face) {
        ChunkFace made;
        for (int n = 0; n < 3; ++n) {
            std::uint32_t& number = known[face.vertices[n]];
            if (!number) number = vertex(simplices_[face.vertices[n]], i, j) + 1;
            made.vertices[n] = number - 1;
        }
        made.labels = {labels[face.first], labels[face.second]};
        chunk_->faces.push_back(made);
    });
}

/// Sides are numbered by the axes of the sweep.
bool StripMesher::has_side(int side) const {
    const int axis = sweep_.axes[side / 2];
    return options_.is_side_of_whole(axis, side % 2 != 0, lattice_.size[axis]);
}

void StripMesher::cap_side(std::uint32_t i, std::uint32_t j, int side) {
    if (!has_side(side)) return;
    const auto labels = cell_labels(i, j);
    // Sides are numbered by the axes of the lattice, triangles and squares were planned by those of the sweep.
    const Label outside = exterior(2 * sweep_.axes[side / 2] + side % 2);
    if (options_.cells == CellKind::kCompact && drops_diagonal(labels_at(labels, squares_[side].corners)))
        cap_square(labels, i, j, side, outside);
    else
        cap_triangles(labels, i, j, side, outside);
}

/// Squares whose diagonal has no vertex.
void StripMesher::cap_square(const std::array<Label, 8>& labels, std::uint32_t i, std::uint32_t j, int side,
                             Label outside) {
    const SquarePlan& plan = squares_[side];
    for (const CaseFace& face : compact_cap(labels_at(labels, plan.corners))) {
        const Label inside = labels[plan.corners[face.first]];
        if (options_.is_background(inside)) continue;
        ChunkFace made;
        for (int n = 0; n < 3; ++n) made.vertices[n] = vertex(plan.simplices[face.vertices[n]], i, j);
        if (plan.turns) std::swap(made.vertices[1], made.vertices[2]);
        made.labels = {inside, outside};
        chunk_->faces.push_back(made);
    }
}

void StripMesher::cap_triangles(const std::array<Label, 8>& labels, std::uint32_t i, std::uint32_t j, int side,
                                Label outside) {
    for (const TrianglePlan& plan : triangles_[side]) {
        const std::array<Label, 3> corner{labels[plan.corners[0]], labels[plan.corners[1]], labels[plan.corners[2]]};
        for (const CaseFace& face : plan.cases[triangle_pattern(corner[0], corner[1], corner[2])]) {
            const Label inside = corner[face.first];
            if (options_.is_background(inside)) continue;
            ChunkFace made;
            for (int n = 0; n < 3; ++n) made.vertices[n] = vertex(plan.simplices[face.vertices[n]], i, j);
            made.labels = {inside, outside};
            chunk_->faces.push_back(made);
        }
    }
}

/// Number of the vertex of a simplex in the chunk; makes the vertex at its first use.
std::uint32_t StripMesher::vertex(const SimplexPlace& place, std::uint32_t i, std::uint32_t j) {
    const std::size_t cell = (std::size_t{j} * width_ + i) * kPlaneSlots + place.offset;
    std::uint32_t* number = nullptr;
    switch (place.table) {
        case Table::kLowPlane:
            number = &planes_[0][cell];
            break;
        case Table::kHighPlane:
            number = &planes_[1][cell];
            break;
        case Table::kRow:
            number = &rows_[0][std::size_t{i} * kRowSlots + place.offset];
            break;
        case Table::kNextRow:
            number = &rows_[1][std::size_t{i} * kRowSlots + place.offset];
            break;
        case Table::kNowhere:
            return make_vertex(place, i, j);
    }
    if (*number == 0) {
        *number = make_vertex(place, i, j) + 1;
        if (place.table == Table::kHighPlane) {
            touched_[1].push_back(static_cast<std::uint32_t>(cell));
            chunk_->active.push_back(*number - 1);
        }
        if (place.table == Table::kLowPlane) touched_[0].push_back(static_cast<std::uint32_t>(cell));
    }
    return *number - 1;
}

std::uint32_t StripMesher::make_vertex(const SimplexPlace& place, std::uint32_t i, std::uint32_t j) {
    const std::array<std::uint32_t, 3> cell{i, j, strip_};
    const Vec3 middle = centroid(place.kind);
    const Step along = extent(place.kind);
    ChunkVertex made;
    VertexSimplex simplex{.base = {}, .kind = lattice_kinds_[place.kind]};
    for (int a = 0; a < 3; ++a) {
        const int axis = sweep_.axes[a];
        const std::uint32_t node = cell[a] + (place.base >> a & 1), size = lattice_.size[axis];
        simplex.base[axis] = options_.first[axis] + node;
        made.position[axis] = lattice_.origin[axis] + (simplex.base[axis] + middle[a]) * lattice_.spacing[axis];
        if (along >> a & 1) continue;
        if (node == 0 && options_.is_side_of_whole(axis, false, size)) made.sides |= SideSet(1 << 2 * axis);
        if (node + 1 == size && options_.is_side_of_whole(axis, true, size)) made.sides |= SideSet(1 << (2 * axis + 1));
    }
    chunk_->vertices.push_back(made);
    if (options_.cuts == QuadCuts::kCones) chunk_->simplices.push_back(simplex);
    return chunk_->carried + static_cast<std::uint32_t>(chunk_->vertices.size()) - 1;
}

void StripMesher::roll_rows() { std::swap(rows_[0], rows_[1]); }

/// The high section becomes the low one of the next strip: its vertices are carried by the next chunk.
void StripMesher::roll_planes() {
    for (std::uint32_t place : touched_[0]) planes_[0][place] = 0;
    touched_[0].clear();
    std::swap(planes_[0], planes_[1]);
    std::swap(touched_[0], touched_[1]);
    for (std::uint32_t n = 0; n < touched_[0].size(); ++n) planes_[0][touched_[0][n]] = n + 1;
    if (strip_ + 2 == count_) chunk_->active.clear();
}

}  // namespace regionmesh
