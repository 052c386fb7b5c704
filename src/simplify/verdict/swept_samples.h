// Which samples can a moving vertex reach? A cheap bound before the exact test.
#pragma once

#include <array>
#include <span>

#include "regionmesh/label.h"
#include "regionmesh/lattice.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct LabelledTriangle {
    std::array<Vec3, 3> at;
    std::array<Label, 2> labels;  // the normal points from the first to the second
};

/// A collapse replaces the faces `before` by those from `position` over their outer edges. So the regions change in the
/// tetrahedra from `position` over the faces and nowhere else. True: no sample lies in one of them, or so near that
/// rounding may take it there; no sample changes its region and no new face meets one. False: perhaps one does.
bool sweeps_no_sample(const Lattice& lattice, std::span<const LabelledTriangle> before, Vec3 position);

}  // namespace regionmesh
