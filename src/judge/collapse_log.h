// Collapses that can be taken back.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// One collapse of an edge of a mesh.
struct LoggedCollapse {
    Vec3 position = {};                     // of `stays` from then on
    std::uint32_t goes = 0, stays = 0;      // vertices
    float goes_bound = 0, stays_bound = 0;  // their error bounds before
    double level = 0;                       // the largest rank so far
    std::uint32_t faces = 0;                // that it removes
    std::uint32_t unused = 0;
};
static_assert(sizeof(LoggedCollapse) == 56);

/// The collapses of a mesh in their order: levels rise.
struct CollapseLog {
    double level = 0;  // of the next
    std::vector<LoggedCollapse> collapses = {};
};

}  // namespace regionmesh
