// Every tuned constant of the stream, with the measurement that chose it.
#pragma once

#include <cstdint>

namespace regionmesh::stream {

// Reading.

/// Sections of fewer samples are not read ahead: handing each over to another thread takes longer than to read it. Two
/// threads, all sections read ahead and none: AAL atlas (39,000 samples a section, to a tenth of its tetrahedra) 1.96
/// and 1.92 s, gzipped 2.04 and 1.93, smoothed 3.50 and 3.41; gzipped CT of a liver (155,000) 1.85 and 1.77. With
/// 2.3 million samples a section there is no difference.
inline constexpr std::uint64_t kFewestReadAhead = 1u << 18;

// The budget (docs/explanation/memory.md, "The plan").

/// Chunks are not shortened below this number of strips: nearly all vertices of their tiles would be locked.
inline constexpr std::uint32_t kFewestStrips = 4;
/// Tiles in flight where memory is short.
inline constexpr std::uint32_t kFewestInFlight = 4;
/// The plan assumes that tiles leave this share of a chunk at most, whatever the target. Measured: 1/7 to 1/3; more for
/// noise.
inline constexpr double kLeftByTiles = 0.5;
/// The same where faces reach over several strips (tetrahedra): tiles then find few faces inside their box.
inline constexpr double kLeftByTilesOfLongFaces = 0.99;
/// A mesh that exceeds its budget is decimated to this number of tenths of it, so that the heap is not built after
/// every chunk.
inline constexpr std::uint64_t kGoalTenths = 6;
/// Where topology or --max-error keep the mesh above its budget, the budget becomes this number of halves of the faces
/// held.
inline constexpr std::uint64_t kGrowthHalves = 3;

// Smoothing.

/// Strips by which the window grows where it was too short; doubled each time. Only artificial labels have needed it.
inline constexpr std::uint32_t kExtraStrips = 8;

// Volumes.

/// --preserve-volume moves vertices after decimation: decimation keeps faces above --min-quality by this factor.
inline constexpr double kQualityMargin = 1.1;

// Tetrahedra (docs/explanation/unstructured.md).

/// Share of --memory for each external sort, and the most that makes it faster.
inline constexpr std::uint64_t kSortShare = 8, kMostSortBytes = std::uint64_t{256} << 20;
/// Most cells of the lattice of strips per tetrahedron, where most of the box is empty.
inline constexpr double kMostCells = 8;
/// Most strips along an axis, since each takes some bytes.
inline constexpr double kMostStrips = 1 << 16;

}  // namespace regionmesh::stream
