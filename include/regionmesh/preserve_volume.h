// Gives the regions of a finished model the volumes that they should have.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/smooth_options.h"

namespace regionmesh {

struct PreserveReport {
    std::uint32_t rounds = 0;
    double drift_before = 0;          // largest |volume / wanted - 1| of a region
    double drift = 0;                 // the same in the end
    std::uint64_t regions_off = 0;    // whose drift stays above kVolumeTolerance
    std::uint64_t held_vertices = 0;  // held back by the guard
    double largest_displacement = 0;  // of one round, length
};
inline constexpr double kVolumeTolerance = 1e-6;

/// Volumes by dense label, or none for those that are free: background, and regions without a closed boundary.
using WantedVolumes = std::vector<std::optional<double>>;

/// Moves vertices along the interface normals until every region has the volume wanted, as nearly as the guard allows.
/// Each round solves for one multiplier a region: vertex v goes by the sum over its regions of multiplier times
/// gradient of the volume, over the area round v. That is the smallest motion, in the mean square over the surface,
/// that changes all volumes by what is missing to first order. The matrix couples regions that share an interface.
/// Quadruple points take part, too: on a coarse model a small region may have no other vertices. Coordinates on the box
/// stay. Uses min_quality, intersect_check and threads of the options. Deterministic.
PreserveReport preserve_volumes(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options);

}  // namespace regionmesh
