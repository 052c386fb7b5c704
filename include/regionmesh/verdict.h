// Why a collapse was accepted or refused.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace regionmesh {

/// In the order of the tests, cheap ones first; the first that fails refuses (docs/explanation/decimate.md).
enum class Verdict { kAccepted, kStrata, kLink, kFold, kQuality, kPinch, kError, kSamples, kIntersect };

inline constexpr std::array kVerdictNames{"accepted", "strata", "link",    "fold",     "quality",
                                          "pinch",    "error",  "samples", "intersect"};
inline constexpr int kVerdictCount = static_cast<int>(kVerdictNames.size());

/// Number of collapses by verdict.
using VerdictCounts = std::array<std::uint64_t, kVerdictCount>;

inline void add(VerdictCounts& counts, const VerdictCounts& more) {
    for (std::size_t n = 0; n < counts.size(); ++n) counts[n] += more[n];
}

}  // namespace regionmesh
