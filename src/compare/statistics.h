// Summarises sampled distances.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "regionmesh/compare.h"

namespace regionmesh {

/// Samples with one weight.
struct WeightedDistances {
    std::span<const double> distances;
    double weight;
};

/// nullopt without samples.
std::optional<DistanceStatistics> statistics_of(const std::vector<WeightedDistances>& parts);

}  // namespace regionmesh
