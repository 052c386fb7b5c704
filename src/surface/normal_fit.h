// The normal that an interface has at a position, from faces near it.
#pragma once

#include <span>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// The middle of a face, relative to the position of the fit, and its normal of length 1.
struct NearFace {
    Vec3 at, normal;
    double area;
};

struct FittedNormal {
    Vec3 normal;   // normal at the position of the fit; of any length
    double error;  // mean square of the normals less those of the first fit
};

/// Least squares, by area: normals are a linear function of position, as on planes and spheres. After the first of
/// `rounds` normals that do not agree with the others count less. `reach` is how far away faces may be. No faces, no
/// normal: 0.
FittedNormal fit_normal(std::span<const NearFace> faces, double reach, int rounds);

}  // namespace regionmesh
