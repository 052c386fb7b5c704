#include "blocks/quotas.h"

#include <algorithm>
#include <cmath>

#include "blocks/simplify_block.h"

namespace regionmesh {
namespace {

/// The share left at a threshold: between trials a power of it, beyond the last as between the last two, and before the
/// first linear, from all faces at no cost.
double share_at(const PieceHeader& piece, double log_threshold) {
    int count = 0;
    while (count < kMostThresholdTrials && piece.left[count] > 0) ++count;
    if (count == 0) return 1;
    const auto at = [&](int n) { return std::log(trial_threshold(n)); };
    const auto left = [&](int n) { return std::log(std::min(piece.left[n], 1.0)); };
    if (log_threshold <= at(0)) return 1 - (1 - std::exp(left(0))) * std::exp(log_threshold - at(0));
    if (count == 1) return std::exp(left(0));
    int n = 1;
    while (n + 1 < count && at(n) < log_threshold) ++n;
    const double slope = std::min((left(n) - left(n - 1)) / (at(n) - at(n - 1)), 0.0);
    return std::min(std::exp(left(n) + slope * (log_threshold - at(n))), 1.0);
}

double faces_at(std::span<const PieceHeader> pieces, double log_threshold) {
    double sum = 0;
    for (const PieceHeader& piece : pieces) sum += static_cast<double>(piece.faces) * share_at(piece, log_threshold);
    return sum;
}

}  // namespace

double threshold_at(std::span<const PieceHeader> pieces, double target) {
    constexpr int kHalvings = 60;
    double low = std::log(trial_threshold(-kMostThresholdTrials)),
           high = std::log(trial_threshold(2 * kMostThresholdTrials));
    for (int n = 0; n < kHalvings; ++n) {
        const double middle = (low + high) / 2;
        (faces_at(pieces, middle) > target ? low : high) = middle;
    }
    return std::exp(high);
}

std::vector<double> shares_at(std::span<const PieceHeader> pieces, double target) {
    const double threshold = std::log(threshold_at(pieces, target)), all = faces_at(pieces, threshold);
    std::vector<double> shares;
    for (const PieceHeader& piece : pieces)
        shares.push_back(std::min(share_at(piece, threshold) * (all > 0 ? target / all : 1), 1.0));
    return shares;
}

}  // namespace regionmesh
