// The sum of weighted squared distances to planes (Garland and Heckbert 1997).
#pragma once

#include "regionmesh/vec3.h"

namespace regionmesh {

/// q(x) = x'Ax + 2b'x + c with A symmetric, x relative to some origin that the holder knows.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Vec3 b;
    double c = 0;

    /// Adds weight * (n . x + offset)^2, n a unit vector.
    void add_plane(Vec3 n, double offset, double weight) {
        const Vec3 wn = weight * n;
        xx += wn.x * n.x, xy += wn.x * n.y, xz += wn.x * n.z, yy += wn.y * n.y, yz += wn.y * n.z, zz += wn.z * n.z;
        b += offset * wn;
        c += weight * offset * offset;
    }
    Quadric& operator+=(const Quadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        b += q.b;
        c += q.c;
        return *this;
    }
    Vec3 times(Vec3 x) const {
        return {xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z, xz * x.x + yz * x.y + zz * x.z};
    }
    double at(Vec3 x) const { return dot(x, times(x)) + 2 * dot(b, x) + c; }
    /// Sum of the weights.
    double weight() const { return xx + yy + zz; }
    /// The same function with its origin moved by `shift`.
    Quadric seen_from(Vec3 shift) const {
        Quadric q = *this;
        const Vec3 a_shift = times(shift);
        q.c = c + 2 * dot(b, shift) + dot(shift, a_shift);
        q.b = b + a_shift;
        return q;
    }
};

/// 40 bytes. Floats are enough because a vertex keeps its quadric relative to its own position.
struct PackedQuadric {
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, bx = 0, by = 0, bz = 0, c = 0;

    PackedQuadric() = default;
    explicit PackedQuadric(const Quadric& q)
        : xx(float(q.xx)),
          xy(float(q.xy)),
          xz(float(q.xz)),
          yy(float(q.yy)),
          yz(float(q.yz)),
          zz(float(q.zz)),
          bx(float(q.b.x)),
          by(float(q.b.y)),
          bz(float(q.b.z)),
          c(float(q.c)) {}
    Quadric unpack() const { return {xx, xy, xz, yy, yz, zz, {bx, by, bz}, c}; }
};

}  // namespace regionmesh
