// The tuned constants of simplify, each with the measurement that chose it.
//
// Unless stated otherwise the measure is the AAL crop of 96 x 96 x 96 samples (1,521,108 faces) to a tenth, not
// smoothed; rms is the distance to the unsimplified surface, both ways, in samples (docs/explanation/performance.md,
// docs/explanation/tiles.md). Costs are in units of scale^4: a squared length times an area.
#pragma once

#include <cstddef>
#include <cstdint>

namespace regionmesh {

// --- Placement -------------------------------------------------------------------------------------------------------

/// Share of the sum of weights that draws toward the middle of the edge. Makes flat stars have one answer, in floats
/// too; costs at most a thousandth of the weight times the squared distance to the middle.
inline constexpr double kRegularisation = 1e-3;

/// Share of weight times squared length that is added to the cost of an edge when it is ranked. rms 0.040 without and
/// 0.034 with it; 366,000 refusals became 80,000; 5.5 s became 5.0 s. 1e-4 to 1e-3 give the least rms, 1e-2 is worse.
inline constexpr double kLengthShare = 3e-4;

/// Weight of the planes along lines, relative to that of faces with an edge of the same length. Garland and Heckbert
/// (1997) give boundaries large weights; 1 keeps lines as close to their place as interfaces.
inline constexpr double kLineWeight = 1;

/// Weight of faces on a hull that is no box, relative to others: points lie exactly on the hull, while interfaces
/// between points are known to half a distance between points.
inline constexpr double kHullWeight = 10;

/// Lindstrom-Turk: a constraint counts where it turns at least this sine (1 degree) out of those before, as in 1998,
/// and where its terms do not cancel to less than this share of their size.
inline constexpr double kLeastConstraintSine = 0.0174524, kLeastConstraintShare = 1e-3;

/// A cost below this share of the largest that the edge could have counts as zero: the star is flat.
inline constexpr double kFlat = 1e-9;

// --- Ranked collapses ------------------------------------------------------------------------------------------------

/// Faces are packed and their tree is built anew when fewer than this share of the face ids is in use.
inline constexpr double kCompactBelow = 0.5;

/// A second choice waits once more where its rank has risen by more than this factor since it was put aside.
inline constexpr double kSameRank = 1.0001;

/// In a large mesh a sweep over the candidates visits the cheapest ones, as many as have to go: at least one in
/// kLeastSweepPart of all, so that finding the limit takes less time than the tests, and at most one in kMostSweepPart.
/// Trim of a head of 2.1 million faces: 1.13 s in exact order; 0.91, 0.85, 0.80 and 0.77 s in sweeps of 0.5, 0.7, 1 and
/// 1.5 times as many as have to go; rms 0.00058 in exact order and in sweeps of 0.5 to 1 times as many.
inline constexpr std::uint32_t kLeastSweepPart = 1024, kMostSweepPart = 8;

// --- Prepass ---------------------------------------------------------------------------------------------------------

/// Cost up to which the prepass collapses. 78 of 100 collapses are made by it, at 2.3 microseconds instead of 8.5 (3.3
/// s became 2.75 s, rms 0.034 became 0.035). 0.003 and 0.01 are no faster, since more is refused, and rms is 0.035.
inline constexpr double kPrepassCost = 1e-3;

/// The same for Lindstrom-Turk: of the same order in the models of docs/explanation/decimate.md; not tuned apart.
inline constexpr double kPrepassVolumeCost = 1e-3;

/// A sweep of the prepass is made while this share of the faces is above the target, so that ranking makes the last
/// third of the way. The sweep that removes less than kLeastSweepGain of the faces is the last.
inline constexpr double kLeastSweepLeft = 0.65, kLeastSweepGain = 0.02;
inline constexpr int kMostSweeps = 16;

/// Faces below the quality bound, as smoothing leaves them, go after the sweeps and before ranking: up to this multiple
/// of the cost of the prepass.
inline constexpr double kSliverShare = 10;

/// After them go folds, up to this multiple (SimplifyOptions::removes_folds): faces beside lines that smoothing has
/// turned over by more than a right angle and one degree; right edges do not reach that. A foam of 60 cells to a tenth:
/// turned over 0.15 % of the area without, 0.07 with 1000; rms of the smoothed atlas 0.0219 and 0.0258. With 100 and
/// 300 less is gained.
inline constexpr double kFoldShare = 1000, kFoldCosine = 0.02;
inline constexpr int kMostFaultSweeps = 3;

/// Vertices with more faces are left to ranking. Of the neighbours that a vertex may go to, the best ones are tried.
inline constexpr int kMostPrepassFaces = 16;
inline constexpr std::size_t kPrepassAttempts = 2;

// --- Tiles -----------------------------------------------------------------------------------------------------------

/// Side of a tile of the first stage, in cells. Tiles of 8 to 32 cells take the same time a collapse (4.0 to 4.3
/// microseconds) and leave the same rms; memory falls from 77 to 47 MB.
inline constexpr std::uint32_t kTileCells = 24;

/// Tiles of thin volumes are wider where at least so many lie along the other axes. A micrograph of five sections
/// to 2.5 million faces, tiles of 24 and 56 cells: 29.7 and 28.4 processor seconds, rms 0.0166 and 0.0156; tiles of 96
/// cells need 29.3 seconds and 12 MB more.
inline constexpr std::uint32_t kFewestAlong = 8;

/// Strips of a chunk, and the samples that it aims at: a chunk holds a fraction of the mesh, and its tiles are cubes.
inline constexpr std::uint32_t kShortestChunk = 8;
inline constexpr std::uint64_t kSamplesPerChunk = 2u << 20;

/// Tiles in work at a time where memory is not short: one that is slow keeps no thread waiting, and they hold less than
/// the heap over the whole mesh takes.
inline constexpr std::uint32_t kTilesInFlight = 16;

/// Threshold of the first stage. 0.015 is 3 % slower (rms of the AAL atlas 0.0295 instead of 0.0313); 0.06 is 8 %
/// faster (0.040, worse than one heap with 0.034).
inline constexpr double kTileThreshold = 3e-2;

/// Tiles of the first stage stop at kTileMargin times the target share. Collapses at zero cost stop at kFreeMargin
/// times the target share where that is above kFreeFrom: to a half of the faces, 2975 became 1404 million instructions
/// (106 thousand faces), and the AAL atlas 1.08 instead of 1.86 times the seconds of a tenth.
inline constexpr double kTileMargin = 1.25, kFreeMargin = 1.02, kFreeFrom = 0.45;

/// Collapses below kFreeCost count as free. The first stage leaves the tiles of a chunk to the second stage, which
/// visits all faces anyway, if they may keep kNearShare or more, and if a chunk before had few free collapses: in
/// addition to the collapses with a cost they removed less than kLeastFreeGain of its faces, and less than half of what
/// the target allows. The first stage is omitted if the target leaves about 1 - kLeastFreeGain or more. A smoothed head
/// to 2 million: 6.0 to 5.5 s, rms 0.0054 to 0.0050. With a kNearShare of 0.85 instead of 0.75 targets of 0.64 gain
/// nothing; with 0.6, targets of 0.55 take up to 10 % less time and 8 to 15 % more memory.
inline constexpr double kFreeCost = 1e-6, kLeastFreeGain = 0.05, kNearShare = 0.75;
inline constexpr std::uint64_t kFreeTrialFaces = 1u << 16;

/// Squares of the sides of the box are joined up to 2^kCapLevels = 8 samples a side, a third of a tile: the faces of
/// larger ones would reach into several tiles, and lock their vertices.
inline constexpr int kCapLevels = 3;

/// Faces are assigned to tiles in parts, on all threads: each has at least kPartFaces faces, and there are at most
/// kMostParts, since each part counts its faces tile by tile.
inline constexpr std::uint32_t kPartFaces = 1u << 15, kMostParts = 64;

/// Cells of a mesh without a lattice are cubes of a typical edge; there are at most kMostCells along an axis.
inline constexpr double kMostCells = 1 << 20;

/// The sample spacing is about this many typical edges of an unsimplified mesh (1.74 for the AAL crop): the threshold
/// of the first stage is in units of the spacing.
inline constexpr double kEdgesPerSpacing = 1.74;

/// The threshold passes over such a mesh aim at this multiple of the target, so that more is left to the ranking over
/// the whole mesh.
inline constexpr double kTrimMargin = 1.4;

/// Passes of the first stage of such a mesh. Its walls cross faces, which leaves more locked vertices than walls in
/// planes of samples; the second pass takes them at the low threshold, too.
inline constexpr int kLowPasses = 2;

// --- Threshold -------------------------------------------------------------------------------------------------------

/// Faces of a tile of a threshold pass. With these constants the second stage takes 0.58 s instead of 1.15 s (AAL
/// atlas) and 3.0 s instead of 8.5 s (25.6 million faces) on two threads, and rms is 0.031 instead of 0.033.
inline constexpr std::uint32_t kTileFaces = 8u << 10;

/// Meshes of fewer tiles are simplified by ranked collapses alone. Of the others at most one part in kPartsInFlight is
/// in work at a time, or kFacesInFlight faces: with fewer, threads wait for each other (AAL atlas to a tenth of its
/// compact faces, two threads: 3.2 s became 2.2 s).
inline constexpr std::uint32_t kFewestTiles = 6, kPartsInFlight = 6, kFacesInFlight = 1u << 16;

/// A pass aims at kPassMargin times the target, and is made while the mesh has more than kWorthPass times the target.
/// The pass that removes less than kLeastPassGain of the faces is the last.
inline constexpr double kPassMargin = 1.03, kWorthPass = 1.15, kLeastPassGain = 0.02;
inline constexpr int kMostPasses = 3;

/// Search: 1 tile in kSampledTiles, about kMostSampledTiles at most. Of a second stage of 1.4 s (a smoothed head, 300
/// tiles), the search takes 0.37 s with 1 tile in 8, and 0.12 s with 16 tiles. The share left is noted at thresholds
/// from kFirstThreshold, which is where the prepass ends, to kThresholdRange times that, each kThresholdStep times the
/// one before; where all of them leave too little, over the range below.
inline constexpr std::uint32_t kSampledTiles = 8, kMostSampledTiles = 16;
inline constexpr double kFirstThreshold = kPrepassCost, kThresholdStep = 1.5, kThresholdRange = 1e9;

/// One tile in kFirstTiles goes first; what it has left corrects the threshold of the others.
inline constexpr std::uint32_t kFirstTiles = 4;

/// A pass that ends below the target is repeated with a lower threshold and a larger least share, at most
/// kMostAttempts times in all; the least share rises to kMostAbove more than the target share.
inline constexpr int kMostAttempts = 3;
inline constexpr double kMostAbove = 0.05;

/// The vertices of a tile that are not locked go down to this part of the target share: locked ones are left to the
/// next pass.
inline constexpr double kLeastInside = 0.9;

/// No tile goes below this part of its share.
inline constexpr double kLeastShare = 0.75;

}  // namespace regionmesh
