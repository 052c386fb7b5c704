#include "blocks/quotas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "blocks/simplify_block.h"

namespace regionmesh {
namespace {

/// What one block can give of the excess: this share of its faces, or this number.
constexpr double kMostShare = 0.01;
constexpr std::uint64_t kMostOfOne = 64;

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

std::vector<double> shares_at_target(std::span<const PieceHeader> pieces, double target) {
    constexpr int kHalvings = 60;
    double low = std::log(trial_threshold(-kMostThresholdTrials)),
           high = std::log(trial_threshold(2 * kMostThresholdTrials));
    for (int n = 0; n < kHalvings; ++n) {
        const double middle = (low + high) / 2;
        (faces_at(pieces, middle) > target ? low : high) = middle;
    }
    const double all = faces_at(pieces, high);
    const double scale = all > 0 ? target / all : 1;
    std::vector<double> shares;
    for (const PieceHeader& piece : pieces) shares.push_back(std::min(share_at(piece, high) * scale, 1.0));
    return shares;
}

std::vector<std::uint64_t> trimmed(std::span<const std::uint64_t> faces, const std::vector<bool>& is_at_limit,
                                   std::uint64_t target) {
    std::vector<std::uint64_t> goals(faces.begin(), faces.end());
    std::vector<std::size_t> order;  // largest first
    for (std::size_t n = 0; n < faces.size(); ++n)
        if (!is_at_limit[n] && faces[n] > 0) order.push_back(n);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return faces[a] > faces[b]; });
    const std::uint64_t all = std::accumulate(faces.begin(), faces.end(), std::uint64_t{0});
    std::uint64_t excess = all - std::min(target, all), overshoot = 0;
    for (const std::size_t n : order) {
        // The block goes to its goal less two at worst, which those that follow must not need.
        if (excess <= overshoot) break;
        const std::uint64_t left = excess - overshoot;
        const std::uint64_t most = std::max(static_cast<std::uint64_t>(kMostShare * double(faces[n])), kMostOfOne);
        const bool is_last = left <= most;
        const std::uint64_t gives = std::min({left, most, faces[n]});
        goals[n] -= gives;
        excess -= gives;
        if (is_last) break;
        overshoot += 2;
    }
    return goals;
}

}  // namespace regionmesh
