// Why a collapse was accepted or refused.
#pragma once

#include <array>
#include <cstdint>

namespace regionmesh {

/// In the order of the tests (docs/decimate.md), cheap ones first; a collapse is refused with the first that fails.
enum class Verdict { kAccepted, kStrata, kLink, kFold, kQuality, kPinch, kIntersect };

inline constexpr int kVerdictCount = 7;
inline constexpr std::array<const char*, kVerdictCount> kVerdictNames{"accepted", "strata", "link",     "fold",
                                                                      "quality",  "pinch",  "intersect"};

using VerdictCounts = std::array<std::uint64_t, kVerdictCount>;

}  // namespace regionmesh
