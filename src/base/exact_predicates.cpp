// The only file that includes CGAL: its exact kernel and intersection tests, LGPL part.
#include "base/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace regionmesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point(Vec3 p) { return {p.x, p.y, p.z}; }
Kernel::Triangle_3 triangle(const Triangle& t) { return {point(t.a), point(t.b), point(t.c)}; }
Kernel::Segment_3 segment(Vec3 a, Vec3 b) { return {point(a), point(b)}; }

/// Does a plane through an edge of t, perpendicular to t, separate s from t? Needed because most neighbours lie in one
/// plane, where orientations in space separate nothing.
bool is_beside(const Triangle& s, const Triangle& t) {
    const Vec3 normal = cross(t.b - t.a, t.c - t.a);
    const auto is_before = [&](Vec3 from, Vec3 to) {
        const Vec3 out = cross(to - from, normal);
        return is_ahead(out, s.a - from) && is_ahead(out, s.b - from) && is_ahead(out, s.c - from);
    };
    return is_before(t.a, t.b) || is_before(t.b, t.c) || is_before(t.c, t.a);
}

/// The same for triangles p a b and p x y: does a plane through p and a or b separate them?
bool is_beside(Vec3 p, Vec3 a, Vec3 b, Vec3 x, Vec3 y) {
    const Vec3 normal = cross(a - p, b - p);
    const auto is_before = [&](Vec3 out) { return is_ahead(out, x - p) && is_ahead(out, y - p); };
    return is_before(cross(a - p, normal)) || is_before(cross(normal, b - p));
}

}  // namespace

int exact_orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return CGAL::orientation(point(a), point(b), point(c), point(d));
}

bool is_degenerate(const Triangle& t) {
    const Vec3 u = t.b - t.a, v = t.c - t.a;
    const double size = dot(u, u) * dot(v, v), area = length2(cross(u, v));
    if (area > 1e-20 * size && size > 1e-200) return false;  // far above its rounding error
    if (!(is_finite(t.a) && is_finite(t.b) && is_finite(t.c))) return true;
    return CGAL::collinear(point(t.a), point(t.b), point(t.c));
}

bool meet(const Triangle& s, const Triangle& t) {
    if (is_beside(s, t) || is_beside(t, s)) return false;
    const int a = orientation(s.a, s.b, s.c, t.a), b = orientation(s.a, s.b, s.c, t.b),
              c = orientation(s.a, s.b, s.c, t.c);
    if (a != 0 && a == b && b == c) return false;
    const int d = orientation(t.a, t.b, t.c, s.a), e = orientation(t.a, t.b, t.c, s.b),
              f = orientation(t.a, t.b, t.c, s.c);
    if (d != 0 && d == e && e == f) return false;
    return CGAL::do_intersect(triangle(s), triangle(t));
}

bool meet_beyond_vertex(Vec3 p, Vec3 a, Vec3 b, Vec3 x, Vec3 y) {
    if (is_beside(p, a, b, x, y) || is_beside(p, x, y, a, b)) return false;
    const int sx = orientation(p, a, b, x), sy = orientation(p, a, b, y);
    if (sx != 0 && sx == sy) return false;
    const int sa = orientation(p, x, y, a), sb = orientation(p, x, y, b);
    if (sa != 0 && sa == sb) return false;
    // The intersection is convex and contains p. If it contains more, it reaches the side opposite p of one triangle.
    return CGAL::do_intersect(segment(a, b), triangle({p, x, y})) ||
           CGAL::do_intersect(segment(x, y), triangle({p, a, b}));
}

bool meet_beyond_edge(Vec3 p, Vec3 q, Vec3 a, Vec3 x) {
    if (is_ahead(cross(q - p, a - p), cross(x - p, q - p))) return false;  // a and x lie on opposite sides of the edge
    if (orientation(p, q, a, x) != 0) return false;
    return CGAL::coplanar_orientation(point(p), point(q), point(a), point(x)) == CGAL::POSITIVE;
}

}  // namespace regionmesh
