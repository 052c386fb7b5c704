// The tuned constants of judge, each with the measurement that chose it.
//
// Unless stated otherwise the measure is the AAL crop of 96 x 96 x 96 samples (1,521,108 faces) to a tenth, not
// smoothed; rms is the distance to the unsimplified surface, both ways, in samples (docs/explanation/performance.md).
#pragma once

#include <cstdint>

namespace regionmesh {

// --- Tests of shape --------------------------------------------------------------------------------------------------

/// Cosine of the largest turn of a face, 78 degrees, and of the least angle between faces at an edge, 5 degrees (P
/// tests 1 and 2).
inline constexpr double kMinTurnCosine = 0.2, kMinDihedralCosine = 0.99619469809174555;

/// A collapse that leaves fewer faces below the bound on quality than there were may make the worst of them this much
/// worse, as long as it keeps this share of the bound. The smoothed AAL atlas to 342,342 and 124,440 faces: without the
/// rule 0.0232 and 0.0842 rms, 157,000 and 243,000 refusals; with 0.8, two thirds and a half of the worst 0.0219 and
/// 0.0763, 0.0744, 0.0748 rms, 57,000 and 117,000 refusals. A model stretched 200 times, to a tenth: without the rule
/// 0.86 rms; with shares of 0, 0.2, 0.3 of the bound 1.27, 0.88, 0.86. A share of 0.5 leaves the atlas at 0.0825.
inline constexpr double kLeastOfWorst = 2.0 / 3, kLeastOfBound = 0.3;

/// A face rises along a direction if its unit normal has at least this component along it. More than the sine of 2.5
/// degrees, so that two rising faces make more than 5 degrees at a common edge (IntersectTest).
inline constexpr float kLeastRise = 0.05f;

// --- Changes tested together --------------------------------------------------------------------------------------

/// Most stripes of a sweep over a large mesh, and least trials of a stripe (try_together.h,
/// src/simplify/rank/edge_sweeps.h). With 128 stripes the trim of a head of 2.1 million faces takes half as long again
/// on one thread, and is no faster on two.
inline constexpr std::uint32_t kMostStripes = 32, kLeastOfStripe = 32;

}  // namespace regionmesh
