// Which passes a run of blocks has, and how far each of them simplifies.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "blocks/manifest.h"

namespace regionmesh {

/// Each pass makes the pieces of all blocks out of those of the pass before; a run ends with the pass that reaches its
/// target.
///
///     pass      blocks        what it does
///     0         as they lie   reconstructs, and simplifies inside the walls
///     1         shifted       simplifies up to a threshold, where the walls of pass 0 were (the seams)
///     2         as they lie   log: notes collapses up to threshold_of_log()
///     3         as they lie   cut: makes the cheapest of them, until left_by_cut() times the target is left
///     4, 5      shifted       log and cut
///     6, 7      as they lie   log and cut, and so on
inline constexpr std::uint32_t kSeams = 1, kFirstLog = 2, kMostLogs = 7;

inline constexpr std::uint32_t kMostBlockPasses = kFirstLog + 2 * kMostLogs;

inline bool is_log(std::uint32_t pass) { return pass >= kFirstLog && (pass - kFirstLog) % 2 == 0; }

/// How many logs came before this one; of a cut, before its log.
inline std::uint32_t logs_before(std::uint32_t pass) { return (pass - kFirstLog) / 2; }

/// Whether blocks are shifted by half a block, so that the walls of a log lie inside the blocks of the pass before it.
inline bool is_shifted(std::uint32_t pass) {
    return pass == kSeams || (pass >= kFirstLog && logs_before(pass) % 2 == 1);
}

/// Trials end at this part of the share that is asked for.
inline constexpr double kTrialsBelow = 0.85;

/// Multiples of the target, by the histograms of pass 0, at which the shifted blocks of pass 1 end, and the first two
/// logs. The histograms say 6 to 27 % less than is left, since walls lock vertices.
inline constexpr double kSeamsAbove = 1.2, kFirstLogAbove = 1.05, kSecondLogAbove = 0.9;

/// The third log goes on to a threshold so many times higher; those that follow as far as collapses are allowed.
inline constexpr double kThirdLog = 8;

inline double threshold_of_log(const Thresholds& thresholds, std::uint32_t pass) {
    const std::array known{thresholds.first_log, thresholds.second_log, kThirdLog * thresholds.second_log};
    const std::uint32_t n = logs_before(pass);
    return n < known.size() ? known[n] : HUGE_VAL;
}

/// The multiple of the target that a cut leaves, or more. The first leaves some, so that the second log reaches what
/// lies at the walls of the first. AAL in blocks of 109 to 155,550 faces: rms 0.0532 with one log, 0.0479 with two.
inline double left_by_cut(std::uint32_t pass) { return logs_before(pass) == 0 ? 1.05 : 1; }

}  // namespace regionmesh
