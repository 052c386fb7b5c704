// Gives the regions of a finished mesh the volumes wanted.
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
    double drift = 0;                 // the same at the end
    std::uint64_t regions_off = 0;    // whose drift stays above kVolumeTolerance
    std::uint64_t held_vertices = 0;  // backtracked
    double largest_displacement = 0;  // of one round, length
};
inline constexpr double kVolumeTolerance = 1e-6;

/// Volumes by dense label, in length^3; none for regions that are free: background, and those without a closed
/// boundary.
using WantedVolumes = std::vector<std::optional<double>>;

/// Moves vertices along the gradients of the volumes until every region has its wanted volume, as nearly as the guard
/// allows. Each round solves for one multiplier per region: vertex v moves by the sum over its regions of multiplier
/// times gradient of the volume, divided by the area round v. To first order this is the smallest motion, in the mean
/// square over the surface, that gives all regions their missing volumes. The matrix couples regions that share an
/// interface. Quadruple points move, too: in a coarse mesh a small region may have no other vertices. Coordinates on
/// the box stay. Uses min_quality, intersect_check and threads of the options. Deterministic.
PreserveReport preserve_volumes(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options);

}  // namespace regionmesh
