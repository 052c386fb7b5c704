#include "regionmesh/statistics.h"

#include <algorithm>
#include <cmath>

namespace regionmesh {
namespace {

struct Weighted {
    double distance, weight;
};

/// The smallest distance that a fraction `share` of the weight does not exceed. Reorders its argument. Halves the range
/// that holds the result, so the time is linear.
double quantile(std::vector<Weighted>& all, double weight, double share) {
    const auto is_nearer = [](const Weighted& a, const Weighted& b) { return a.distance < b.distance; };
    auto first = all.begin(), last = all.end();
    double below = 0;  // weight before `first`
    while (last - first > 1) {
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, is_nearer);
        double half = 0;
        for (auto at = first; at != middle; ++at) half += at->weight;
        if (below + half >= share * weight) {
            last = middle;
        } else {
            below += half;
            first = middle;
        }
    }
    return first->distance;
}

}  // namespace

std::optional<DistanceStatistics> statistics_of(const std::vector<WeightedDistances>& parts) {
    DistanceStatistics result;
    double weight = 0, sum = 0, squares = 0;
    std::vector<Weighted> all;
    for (const WeightedDistances& part : parts) {
        double part_sum = 0, part_squares = 0;
        for (const double distance : part.distances) {
            part_sum += distance;
            part_squares += distance * distance;
            result.max = std::max(result.max, distance);
            all.push_back({distance, part.weight});
        }
        sum += part.weight * part_sum;
        squares += part.weight * part_squares;
        weight += part.weight * static_cast<double>(part.distances.size());
    }
    if (all.empty()) return std::nullopt;
    result.samples = all.size();
    result.mean = sum / weight;
    result.rms = std::sqrt(squares / weight);
    result.quantile_95 = quantile(all, weight, 0.95);
    return result;
}

}  // namespace regionmesh
