// Which samples can a moving vertex reach? A cheap bound before the exact test.
#pragma once

#include <span>

#include "judge/labelled_triangle.h"
#include "regionmesh/lattice.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

enum class SweptSamples {
    kNone,     // none changes its region, and no new face meets one
    kSome,     // one changes its region
    kPerhaps,  // only the exact test can tell
};

/// A collapse replaces the faces `before` by those from `position` over their outer edges. So the regions change in the
/// tetrahedra from `position` over the faces and nowhere else. kNone where no sample lies in one of them, or so near
/// that rounding may take it there; kSome where one lies deeper than rounding in one of them, and outside the others.
SweptSamples find_swept_samples(const Lattice& lattice, std::span<const LabelledTriangle> before, Vec3 position);

}  // namespace regionmesh
