#include "simplify/placement/least_cost.h"

#include <algorithm>

namespace regionmesh {
namespace {

/// Solves the symmetric positive definite system q.A x = r by Cramer's rule.
Vec3 solve(const Quadric& q, Vec3 r) {
    const double c00 = q.yy * q.zz - q.yz * q.yz, c01 = q.xz * q.yz - q.xy * q.zz, c02 = q.xy * q.yz - q.xz * q.yy;
    const double c11 = q.xx * q.zz - q.xz * q.xz, c12 = q.xy * q.xz - q.xx * q.yz, c22 = q.xx * q.yy - q.xy * q.xy;
    const double determinant = q.xx * c00 + q.xy * c01 + q.xz * c02;
    if (!(determinant > 0)) return {};
    return Vec3{c00 * r.x + c01 * r.y + c02 * r.z, c01 * r.x + c11 * r.y + c12 * r.z,
                c02 * r.x + c12 * r.y + c22 * r.z} /
           determinant;
}

/// Takes a coordinate out of the system by setting it to `value`.
void lock(Quadric& q, Vec3& r, int axis, double value, double scale) {
    if (axis == 0) {
        r = {scale * value, r.y - q.xy * value, r.z - q.xz * value};
        q.xx = scale, q.xy = 0, q.xz = 0;
    } else if (axis == 1) {
        r = {r.x - q.xy * value, scale * value, r.z - q.yz * value};
        q.yy = scale, q.xy = 0, q.yz = 0;
    } else {
        r = {r.x - q.xz * value, r.y - q.yz * value, scale * value};
        q.zz = scale, q.xz = 0, q.yz = 0;
    }
}

}  // namespace

Quadric merged_quadric(const EdgeEnds& edge, Vec3 origin) {
    Quadric q = edge.goes_quadric.unpack().seen_from(origin - edge.goes);
    q += edge.stays_quadric.unpack().seen_from(origin - edge.stays);
    return q;
}

double cost_at(const EdgeEnds& edge, Vec3 position) { return std::max(merged_quadric(edge, position).c, 0.0); }

LeastCost least_cost(const EdgeEnds& edge) {
    const Vec3 middle = 0.5 * (edge.goes + edge.stays);
    const Quadric q = merged_quadric(edge, middle);
    const double pull = kRegularisation * q.weight() + 1e-30;
    Quadric system = q;
    system.xx += pull, system.yy += pull, system.zz += pull;
    Vec3 right = -q.b;
    const auto is_locked = [&](int axis) { return (edge.stays_sides >> (2 * axis) & 3) != 0; };
    if (edge.stays_sides != 0)
        for (int axis = 0; axis < 3; ++axis)
            if (is_locked(axis)) lock(system, right, axis, edge.stays[axis] - middle[axis], q.weight() + pull);
    const Vec3 step = solve(system, right);
    LeastCost result{middle + step, 0};
    if (edge.stays_sides != 0)
        for (int axis = 0; axis < 3; ++axis)
            if (is_locked(axis)) result.position[axis] = edge.stays[axis];
    result.cost = std::max(q.at(result.position - middle), 0.0);
    return result;
}

}  // namespace regionmesh
