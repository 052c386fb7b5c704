// The tuned constants of smoothing, with a measurement where one chose the value.
#pragma once

#include <cstdint>

namespace regionmesh::smoothing {

// Backtracking (smooth/filters/backtrack.h, docs/explanation/smoothing.md, "The guard").

/// The way from a vertex's smoothed position back to its origin is divided into this number of steps.
inline constexpr std::uint8_t kFullBacktrack = 8;
/// Rounds over the faces before intersections are resolved, and the steps that a faulty face asks for after the first
/// round, which finds its steps exactly.
inline constexpr std::uint32_t kRounds = 3;
inline constexpr std::uint8_t kRoundStep = 2;
/// Steps that the corners of a faulty face go back while intersections are resolved.
inline constexpr std::uint8_t kResolveStep = 2;
/// Without --min-quality, faces still may not become needles whose normal is lost in rounding.
inline constexpr double kLeastQuality = 1e-4;

// Reach along the sweep, in units of the larger of scale and chunk thickness (docs/explanation/smoothing.md, "The
// window of strips"). A vertex that would go farther is stopped and counted; no measured run has one.

/// One unit, and one more per this number of passes.
inline constexpr double kTaubinPassesPerUnit = 20, kLaplacianPassesPerUnit = 10;

// The lattice filter (smooth/lattice/lattice_smoother.h; docs/explanation/smoothing.md, "Which positions").

/// Least weight of a node of a vertex's simplex: below 1/4.
inline constexpr double kLatticeMargin = 0.01;
/// Bytes of its window per face: packed chunks, sites, estimates, and samples of the levels. Measured: 40 for the aal
/// atlas (45 with a background, 46 with sections five times as far apart), 33 and 40 for foams, 57 for an atlas of
/// smaller regions. Of dense surfaces, with more faces a sample than kDenseFaces, most vertices are on lines: 98 to 112
/// for noise and checkers, and 143 with what else smoothing holds (11 to 52 faces a sample; other volumes have at most
/// 1.5).
inline constexpr std::uint64_t kLatticeBytesPerFace = 64, kDenseLatticeBytesPerFace = 144;
inline constexpr double kDenseFaces = 4;
/// Sizes of blocks in finest spacings. Terraces are as many samples wide as sections are far apart, for the same slope,
/// so anisotropic lattices start one scale coarser.
inline constexpr double kSmallestBlock = 2, kLargestBlock = 8, kLargestBlockAnisotropic = 16;
/// From this ratio of coarsest to finest spacing: less than 2, which many volumes have up to the rounding of a header.
inline constexpr double kAnisotropic = 1.9;

// Volumes (smooth/preserve_volume.cpp; docs/explanation/smoothing.md, "Volumes"): IN100 needs
// 8 rounds, decimated to a tenth 5.

inline constexpr std::uint32_t kMostVolumeRounds = 30;
/// Relative drift at which another round gains nothing.
inline constexpr double kEnoughDrift = 1e-9;
/// Per round, in typical edges: the mean displacement that a region may ask of its boundary, and the longest
/// displacement of a vertex.
inline constexpr double kMostAsked = 0.05, kLongestStep = 0.2;
/// A region that gets less than this share of the volume that it asks for, kPatience rounds in succession, is given up:
/// it would only push its neighbours about.
inline constexpr double kLeastGain = 0.3;
inline constexpr int kPatience = 4;
/// Where regions end farther off than they began, they stay as they were and the rounds begin again: this number of
/// times in all. A third brought nothing (IN100 to a fifth, pv_nesting: 2 and 29 regions off after each).
inline constexpr std::uint32_t kMostAttempts = 2;
/// Rounds for which a vertex that backtracked is not moved.
inline constexpr std::uint8_t kRestRounds = 3;

// Items of a task for one thread. Any value gives the same result.

inline constexpr std::uint32_t kNeighbourTask = 2048, kRelaxTask = 4096, kNifpmsTask = 256;  // vertices
inline constexpr std::uint32_t kRoundTask = 4096, kCrossingTask = 512;                       // faces

}  // namespace regionmesh::smoothing
