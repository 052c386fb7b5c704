// A quadric height function fitted to a piece of an interface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// A point of an interface: the mean of some sites of one kind of simplex near each other.
struct HeightSample {
    Vec3 position;
    double weight;
    std::span<const Vec3> edges;  // of their simplex
};

/// Height over the plane through `centre` square to `normal`: along u and v, q0 + q1 u + q2 v + q3 u^2 + q4 u v + q5
/// v^2.
struct HeightQuadric {
    Vec3 centre, normal, u, v;
    std::array<double, 6> q{};

    HeightQuadric(Vec3 at, Vec3 unit_normal);

    /// Height of p over the quadric: positive on the side of the normal.
    double height(Vec3 p) const {
        const Vec3 d = p - centre;
        const double a = dot(d, u), b = dot(d, v);
        return dot(d, normal) - (q[0] + a * (q[1] + q[3] * a + q[4] * b) + b * (q[2] + q[5] * b));
    }
    Vec3 gradient(Vec3 p) const {
        const Vec3 d = p - centre;
        const double a = dot(d, u), b = dot(d, v);
        return normal - (q[1] + 2 * q[3] * a + q[4] * b) * u - (q[2] + q[4] * a + 2 * q[5] * b) * v;
    }

    /// Weighted least squares. The true surface may cross a sample's simplex anywhere, so a sample counts by the
    /// inverse square of the extent of its simplex along the normal, at least `finest_extent`: the steps of a terrace
    /// say where the surface is, its plain does not. `reach` scales u and v. False if the sums are degenerate.
    bool fit(std::span<const HeightSample> samples, double reach, double finest_extent);
};

/// Least and greatest of slope . (p - centroid) over the nodes p of a simplex with these edges from its first node.
struct ExtentAlong {
    double low, high;
};
inline ExtentAlong extent_along(std::span<const Vec3> edges, Vec3 slope) {
    if (edges.size() == 1) {
        const double half = std::abs(dot(slope, edges[0])) / 2;
        return {-half, half};
    }
    double low = 0, high = 0, sum = 0;
    for (Vec3 edge : edges) {
        const double at = dot(slope, edge);
        low = std::min(low, at);
        high = std::max(high, at);
        sum += at;
    }
    const double middle = sum / static_cast<double>(edges.size() + 1);
    return {low - middle, high - middle};
}

}  // namespace regionmesh
