// A quadric height function fitted to a piece of an interface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/lanes.h"
#include "cells/kuhn.h"
#include "smooth/lattice_point.h"

namespace regionmesh {

/// Least and greatest of slope . (p - centroid) over the nodes p of a simplex.
struct ExtentAlong {
    float low, high;
    float size() const { return high - low; }
};
ExtentAlong extent_along(int kind, Float3 slope, Float3 spacing);

/// Points of an interface round the centre of a fit, four at a time. A point of weight 0 does not count.
struct HeightSamples {
    struct Four {
        Float4 u, v, height;  // in finest spacings
        Float4 weight;
        std::array<std::uint8_t, 4> kind;  // of the simplices
    };
    std::vector<Four> fours;
    std::uint32_t count = 0;  // of the fours in use
};

/// Height over the plane through `centre` square to `normal`: along u and v, q0 + q1 u + q2 v + q3 u^2 + q4 u v + q5
/// v^2. Lengths are in finest spacings.
struct HeightQuadric {
    LatticePoint centre;
    Float3 normal, u, v;
    std::array<float, 6> q{};

    HeightQuadric(LatticePoint at, Float3 unit_normal);

    Float3 along(Float3 d) const { return {dot(d, u), dot(d, v), dot(d, normal)}; }
    /// Of the point with these coordinates along u, v and the normal; positive on the side of the normal.
    float height(Float3 at) const {
        return at.z - (q[0] + at.x * (q[1] + q[3] * at.x + q[4] * at.y) + at.y * (q[2] + q[5] * at.y));
    }
    Float3 gradient(Float3 at) const {
        return normal - (q[1] + 2 * q[3] * at.x + q[4] * at.y) * u - (q[2] + q[4] * at.x + 2 * q[5] * at.y) * v;
    }

    /// Weighted least squares. The true surface may cross a sample's simplex anywhere, so a sample counts by the
    /// inverse square of the extent of its simplex along the normal, at least `finest_extent`: the steps of a terrace
    /// say where the surface is, its plain does not. Repeated `rounds` times with the slopes found before. `reach`
    /// scales u and v. False if the sums are degenerate.
    bool fit(const HeightSamples& samples, Float3 spacing, float reach, int rounds);
};

}  // namespace regionmesh
