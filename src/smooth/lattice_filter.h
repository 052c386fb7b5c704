// Smoothing inside lattice simplices: keeps every sample in its region by construction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "smooth/lattice_simplex.h"
#include "smooth/lattice_sites.h"

namespace regionmesh {

struct LatticeFilterOptions {
    double margin = 0.01;  // least weight of a node of a vertex's simplex: 0 < margin < 1/4
    double reach = 0;      // size of the largest blocks, in units of the finest spacing; 0: from the spacing
    std::uint32_t threads = 0;
};

/// New positions of the vertices of a reconstruction, each strictly inside its lattice simplex: see
/// docs/explanation/lattice-smoothing.md. Requires a surface made by
/// StripMesher with QuadCuts::kCones: other cuts can cross. Deterministic.
std::vector<Vec3> lattice_positions(std::span<const Vec3> positions, std::span<const LatticeFace> faces,
                                    const LatticeFrame& frame, const LatticeFilterOptions& options = {});

}  // namespace regionmesh
