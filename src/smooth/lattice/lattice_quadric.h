// A quadric height function fitted to a piece of an interface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/lanes.h"
#include "cells/kuhn.h"
#include "smooth/lattice/lattice_point.h"

namespace regionmesh {

/// The kinds of four simplices.
using Kinds4 = std::array<std::uint8_t, 4>;

/// The eight steps in a cell as vectors.
class StepVectors {
public:
    /// In the unit of the spacing.
    explicit StepVectors(Float3 spacing);

    Float3& operator[](Step step) { return steps_[step]; }
    Float3 operator[](Step step) const { return steps_[step]; }
    /// From the first node of each simplex to its n-th; zero where it has fewer.
    Lanes3<Float4> to_node(const Kinds4& kind, int n) const {
        const auto step = [&](int lane) { return steps_[kKinds[kind[lane]].steps[n]]; };
        return side_by_side(step(0), step(1), step(2), step(3));
    }
    /// The edge, where it is one.
    Lanes3<Float4> edge(const Kinds4& kind) const {
        return side_by_side(edge_[kind[0]], edge_[kind[1]], edge_[kind[2]], edge_[kind[3]]);
    }

private:
    std::array<Float3, 8> steps_;
    std::array<Float3, kKindCount> edge_{};  // one per kind; zero for other simplices
};

inline bool are_edges(const Kinds4& kind) { return std::max({kind[0], kind[1], kind[2], kind[3]}) < kFirstTriangle; }

/// Least and greatest of slope . (p - first node) over the nodes p of each simplex.
struct Extent4 {
    Float4 low{}, high{}, sum{};  // sum over the nodes
};
template <class Height>
Extent4 extent_of(const Kinds4& kind, Height&& height_of_node) {
    Extent4 extent;
    const int end = are_edges(kind) ? 2 : 4;
    for (int n = 1; n < end; ++n) {
        const Float4 at = height_of_node(n);
        extent.low = least(extent.low, at);
        extent.high = greatest(extent.high, at);
        extent.sum += at;
    }
    return extent;
}

/// Points of an interface round the centre of a fit, four at a time. A point of weight 0 does not count.
struct HeightSamples {
    struct Four {
        Float4 u, v, height;  // u, v and height in finest spacings
        Float4 weight;
        Kinds4 kind;  // kind of the simplices
    };
    std::vector<Four> fours;
    std::uint32_t count = 0;  // count of the fours in use
};

/// Axes of a fit.
struct TangentFrame {
    Float3 normal, u, v;

    explicit TangentFrame(Float3 unit_normal);
    Float3 along(Float3 d) const { return {dot(d, u), dot(d, v), dot(d, normal)}; }
};

/// Height over a surface near `centre`: constant + gradient . d + d . curvature d / 2 at centre + d. Lengths are in
/// finest spacings.
struct HeightQuadric {
    LatticePoint centre;
    Float3 normal;  // unit length; heights are positive on its side
    float constant = 0;
    Float3 gradient;
    std::array<float, 6> curvature{};  // xx, yy, zz, xy, xz, yz

    struct At {
        Float4 height;
        Lanes3<Float4> gradient;
    };
    At at(const Lanes3<Float4>& d) const {
        const auto& k = curvature;
        const Lanes3<Float4> slope{gradient.x + k[0] * d.x + k[3] * d.y + k[4] * d.z,
                                   gradient.y + k[3] * d.x + k[1] * d.y + k[5] * d.z,
                                   gradient.z + k[4] * d.x + k[5] * d.y + k[2] * d.z};
        const Lanes3<Float4> twice{slope.x + gradient.x, slope.y + gradient.y, slope.z + gradient.z};
        return {constant + 0.5f * dot(twice, d), slope};
    }

    /// Weighted least squares of a height over the plane through the centre square to the normal: q0 + q1 u + q2 v + q3
    /// u^2 + q4 u v + q5 v^2. The true surface may cross a sample's simplex anywhere, so a sample counts by the inverse
    /// square of the extent of its simplex along the normal, at least `least_extent` finest spacings: the steps of a
    /// terrace say where the surface is, its plain does not. Repeated `rounds` times with the slopes found before.
    /// `reach` scales u and v. False if the sums are degenerate.
    bool fit(const HeightSamples& samples, const TangentFrame& frame, Float3 spacing, float reach, int rounds,
             float least_extent);
    /// Root of the sum of the squares of the second derivatives.
    float curvedness() const {
        const auto& k = curvature;
        return std::sqrt((k[0] * k[0] + k[1] * k[1] + k[2] * k[2]) + 2 * (k[3] * k[3] + k[4] * k[4] + k[5] * k[5]));
    }

private:
    void set_heights(const std::array<double, 6>& q, const TangentFrame& frame);
};

}  // namespace regionmesh
