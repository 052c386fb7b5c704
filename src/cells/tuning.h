// Every tuned constant of meshing, with the measurement that chose it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh::cells {

// Tetrahedra (docs/explanation/unstructured.md).

/// Tetrahedra read at a time. Any value gives the same result.
inline constexpr std::size_t kPiece = 1 << 14;

/// Per point while points are ranked: position, input and dense label, number and rank; and 4 bytes for points at the
/// same position.
inline constexpr std::uint64_t kRankingBytesPerPoint =
    sizeof(Vec3) + sizeof(InputLabel) + sizeof(Label) + 2 * sizeof(std::uint32_t) + 4;
static_assert(kRankingBytesPerPoint == 48);

/// Per point while faces are made, and for the active simplices per point across the sweep: measured on random points
/// and on lattices.
inline constexpr std::uint64_t kMeshingBytesPerPoint = 32, kActiveBytes = 4000;

/// The program, and the least that it sorts with.
inline constexpr std::uint64_t kLeastBytes = std::uint64_t{24} << 20;

}  // namespace regionmesh::cells
