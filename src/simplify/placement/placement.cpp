#include "simplify/placement/placement.h"

#include <array>

namespace regionmesh {
namespace {

/// In the order of PlacementKind. A new placement is one file, one row and its name in regionmesh/simplify.h.
constexpr std::array kMakers{make_quadric_placement, make_lindstrom_turk_placement};
static_assert(kMakers.size() == kPlacementNames.size());

}  // namespace

Vec3 average_of_link(const Mesh& mesh, const EdgeStar& star) {
    Vec3 sum;
    for (VertexId v : star.link) sum += mesh.position(v) - star.at_stays;
    Vec3 average = star.at_stays + sum / static_cast<double>(star.link.size());
    for (int axis = 0; axis < 3; ++axis)
        if (mesh[star.stays].sides >> (2 * axis) & 3) average[axis] = star.at_stays[axis];
    return average;
}

std::unique_ptr<Placement> make_placement(const Mesh& mesh, const SimplifyOptions& options, std::uint32_t threads) {
    return kMakers[static_cast<std::size_t>(options.placement)](mesh, options, threads);
}

}  // namespace regionmesh
