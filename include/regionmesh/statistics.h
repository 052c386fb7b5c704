// What a set of sampled distances amounts to.
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
    double max = 0;          // of the samples: the surface may be a little further away between them
    double quantile_95 = 0;  // the smallest sampled distance that 95 % of the area or length do not exceed
};

/// Samples with one weight.
struct WeightedDistances {
    std::span<const double> distances;
    double weight;
};

/// Nothing where there is no sample.
std::optional<DistanceStatistics> statistics_of(const std::vector<WeightedDistances>& parts);

}  // namespace regionmesh
