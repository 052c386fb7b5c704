// Statistics of sampled distances.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace regionmesh {

/// Distances in the unit of the coordinates, weighted by the area or length each sample stands for.
struct DistanceStatistics {
    std::uint64_t samples = 0;
    double rms = 0, mean = 0;
    double max = 0;          // of the samples; between them the surface may be slightly farther away
    double quantile_95 = 0;  // the smallest sampled distance that 95 % of the area or length does not exceed
};

/// Samples that share one weight.
struct WeightedDistances {
    std::span<const double> distances;
    double weight;
};

/// None where there is no sample.
std::optional<DistanceStatistics> statistics_of(const std::vector<WeightedDistances>& parts);

}  // namespace regionmesh
