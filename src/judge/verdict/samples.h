// Does a change of the surface carry samples of the lattice into other regions?
#pragma once

#include <span>

#include "judge/verdict/swept_samples.h"
#include "regionmesh/lattice.h"

namespace regionmesh {

/// Faces are replaced by others with the same boundary: does any sample of the lattice change its region, or does a new
/// face that is no cap come so near to a sample that rounding may take it there? Exact.
bool changes_samples(const Lattice& lattice, std::span<const LabelledTriangle> before,
                     std::span<const LabelledTriangle> after);

}  // namespace regionmesh
