// Sweeps over the vertices inside flat pieces of interfaces, before all else: no faces round them have to be looked at.
#pragma once

#include <cstdint>

#include "judge/judge.h"

namespace regionmesh {

/// A vertex is flat if its faces form a disk of one interface in a plane square to an axis, to the last bit, as on a
/// side of the box. It goes to the neighbour that leaves the best faces, in sweeps like those of the prepass. Where no
/// new face is turned over, the new faces tile the very polygon that the old ones did: nothing is pinched or met, no
/// sample changes its region, and no cost is above 0. So neither quadrics nor a tree of faces are needed, which are
/// then made of fewer faces. Fixed vertices neither go nor get faces. Ends where another sweep would go below the
/// target. Requires label counts. Returns the number of vertices
/// removed.
std::uint32_t remove_flat_vertices(Judge& judge, std::uint32_t target_faces);

}  // namespace regionmesh
