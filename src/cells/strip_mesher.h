// Turns sections into faces, one strip between two consecutive sections at a time (P 3.1-3.3).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cells/compact_cells.h"
#include "cells/marching_tetrahedra.h"
#include "cells/mixed_cells.h"
#include "regionmesh/label.h"
#include "regionmesh/lattice.h"
#include "surface/chunk.h"

namespace regionmesh {

struct StripOptions {
    bool cap = true;                     // split the lattice triangles on the six sides of the box into faces
    std::vector<Label> background = {};  // dense labels whose faces with the exterior are not made
    CellKind cells = CellKind::kTetrahedra;
    QuadCuts cuts = QuadCuts::kBestQuality;  // cuts of quads in tetrahedra and in their triangles on the box
    // A part of a larger lattice: the index of its first sample and the samples of the whole, along x, y, z. 0: the
    // part ends where the whole does. Vertices and caps are those that the whole has there.
    std::array<std::uint32_t, 3> first{0, 0, 0}, whole{0, 0, 0};

    bool is_side_of_whole(int axis, bool is_high, std::uint32_t size) const {
        return is_high ? whole[axis] == 0 || first[axis] + size == whole[axis] : first[axis] == 0;
    }
    bool is_background(Label label) const {
        return std::find(background.begin(), background.end(), label) != background.end();
    }
};

/// Meshes strips. A vertex is found by its lattice key, a base node and one of 26 kinds, in flat tables that cover two
/// sections (kinds in the plane of a section, kBytesPerSample) and two rows (all other kinds).
/// With QuadCuts::kCones, which smoothing inside the lattice needs, chunks get the simplices of their vertices.
/// Positions are origin + (index + centroid) * spacing, in the axes of the lattice; its direction is not applied. The
/// index and the origin are those of the whole where the lattice is a part of a larger one.
class StripMesher {
    static constexpr int kPlaneSlots = 6;  // node, 3 edges, 2 triangles in the plane of a section
    static constexpr int kRowSlots = 14;   // 4 edges, 10 triangles out of it

public:
    /// Requires at least two samples along every axis.
    StripMesher(const Lattice& lattice, Sweep sweep, StripOptions options);

    /// Meshes the strip between sections `strip` and `strip + 1`, appending to an empty chunk. Strips come in order.
    void mesh(std::span<const Label> low, std::span<const Label> high, Chunk& chunk);

    std::size_t bytes() const;
    /// A section: two planes of vertex numbers.
    static constexpr std::uint64_t kBytesPerSample = 2 * kPlaneSlots * sizeof(std::uint32_t);

private:
    /// The table that holds the number of a vertex, and the place in it relative to the cell.
    enum class Table : std::uint8_t { kLowPlane, kHighPlane, kRow, kNextRow, kNowhere };
    struct SimplexPlace {
        Table table;
        std::uint8_t kind;
        Step base;  // base node relative to the cell's first node
        std::uint32_t offset;
    };
    struct TetrahedronPlan {
        std::array<Step, 4> corners;
        std::array<SimplexPlace, 16> simplices;  // index: CornerSet
        TetrahedronCases cases;
    };
    struct TrianglePlan {
        std::array<Step, 3> corners;  // corners within the cell, turned outward
        std::array<SimplexPlace, 8> simplices;
        TriangleCases cases;
    };

    struct SquarePlan {
        bool turns;
        std::array<Step, 4> corners;  // corners within the cell; the ends of the diagonal are the first and the last
        std::array<SimplexPlace, 16> simplices;
    };

    SimplexPlace place_of(const Step* corners, unsigned set) const;
    void plan_tetrahedra();
    void plan_triangles();
    void plan_compact_cells();
    bool has_side(int side) const;
    void mesh_row(std::uint32_t j);
    void mesh_in_tetrahedra(std::uint32_t i, std::uint32_t j);
    void mesh_compact(std::uint32_t i, std::uint32_t j);
    void cap_side(std::uint32_t i, std::uint32_t j, int side);
    void cap_square(const std::array<Label, 8>& labels, std::uint32_t i, std::uint32_t j, int side, Label outside);
    void cap_triangles(const std::array<Label, 8>& labels, std::uint32_t i, std::uint32_t j, int side, Label outside);
    std::array<Label, 8> cell_labels(std::uint32_t i, std::uint32_t j) const;
    std::uint32_t vertex(const SimplexPlace& place, std::uint32_t i, std::uint32_t j);
    std::uint32_t make_vertex(const SimplexPlace& place, std::uint32_t i, std::uint32_t j);
    void roll_rows();
    void roll_planes();

    Lattice lattice_;
    Sweep sweep_;
    std::array<std::uint8_t, kKindCount> lattice_kinds_;  // by kind along the axes of the sweep
    StripOptions options_;
    std::uint32_t width_, height_, count_;  // samples along the fast axis, the slow axis, the sweep
    std::array<TetrahedronPlan, 6> tetrahedra_;
    std::array<std::vector<TrianglePlan>, 6> triangles_;
    std::array<SimplexPlace, kCellSimplexCount> simplices_;  // simplices of compact cells
    std::array<SquarePlan, 6> squares_;

    std::uint32_t strip_ = 0;
    std::span<const Label> low_, high_;
    Chunk* chunk_ = nullptr;
    std::vector<std::uint32_t> planes_[2];  // vertex number + 1, 0 for none yet
    std::vector<std::uint32_t> rows_[2];
    std::vector<std::uint32_t> touched_[2];        // places in planes_ that are not 0
    MixedCells mixed_;                             // mixed cells of a row
    const CompactCells* compact_cells_ = nullptr;  // nullptr unless CellKind::kCompact
};

}  // namespace regionmesh
