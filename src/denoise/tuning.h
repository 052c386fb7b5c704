// Tuned constants of src/denoise, with what they were measured on (docs/how-to/smooth.md).
#pragma once

#include <cstdint>

namespace regionmesh::denoising {

// A sample is a bump if at most this number of its 26 neighbours has its label. A bump on a plane has 9; clean shapes
// have none at 8 with dents to match, by 21 shapes and foams.
inline constexpr int kMostOfBump = 8;
inline constexpr double kFewestBoundary = 1000;  // shares of fewer boundary samples mean nothing

// Shares from which labels count as rough. Clean shapes and foams: 0. IN100, aal, labDCT 0.003; Zubal's head 0.0014.
inline constexpr double kRagged = 0.003, kRaggedIfSpeckled = 0.0004;
// Clean shapes: 0. Half a per cent of all samples flipped: 0.02 to 0.04.
inline constexpr double kStray = 0.0005, kManyStrays = 0.01;

// Factors of enlargement that are looked for; boundaries that agree with them, as a share; positions of boundaries, at
// least.
inline constexpr double kLeastFactor = 1.2, kMostFactor = 8.5, kShareOnEdges = 0.995;
inline constexpr int kFewestPositions = 8;
inline constexpr int kFewestSamePositions = 3;  // for a factor found along another axis
inline constexpr double kEmptyPosition = 0.03;  // of the most boundaries at a position nearby

// Standard deviation of the weights round a sample, in finest spacings, and the share of bumps from which the wider one
// is taken. Ragged by 5 %: 0.013 to 0.022, by 20 %: 0.035 to 0.056.
inline constexpr double kDeviation = 1, kWideDeviation = 1.5, kVeryRagged = 0.03;
// From this share on threads and pinholes are cut. IN100: 0.003; ragged by 5 %: 0.013.
inline constexpr double kCutRagged = 0.01;

}  // namespace regionmesh::denoising
