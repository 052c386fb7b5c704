// How far smoothing in the lattice looks where nobody says.
#pragma once

#include "regionmesh/vec3.h"
#include "smooth/lattice/lattice_simplex.h"
#include "smooth/tuning.h"

namespace regionmesh {

/// The largest block, in finest spacings, for SmoothOptions::reach 0 where samples have these distances.
inline double usual_reach(const Vec3& spacing) {
    LatticeFrame frame;
    frame.spacing = spacing;
    return frame.is_anisotropic() ? smoothing::kLargestBlockAnisotropic : smoothing::kLargestBlock;
}

}  // namespace regionmesh
