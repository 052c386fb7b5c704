#include "check/nesting_ray.h"

#include <algorithm>

namespace regionmesh {

Label outermost(const NestedVolumes& volumes) {
    if (volumes.empty()) return exterior(0);
    return std::ranges::min_element(volumes, {}, &NestedVolumes::value_type::second)->first;
}

NestingHit nesting_hit(const Mesh& mesh, FaceId f, Vec3 from) {
    const auto p = mesh.corners(f);
    if (std::ranges::find(p, from) != p.end()) return {.distance = 0};
    const Vec3 e = p[1] - p[0], g = p[2] - p[0];
    const Vec3 h = cross(kNestingRay, g);
    const double d = dot(e, h);
    if (d == 0) return {};
    const Vec3 s = from - p[0];
    const double u = dot(s, h) / d;
    const Vec3 q = cross(s, e);
    const double v = dot(kNestingRay, q) / d, t = dot(g, q) / d;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) return {};
    const bool along_normal = dot(cross(e, g), kNestingRay) > 0;
    return {t, mesh[f].labels[along_normal ? 0 : 1]};
}

bool is_nested(const CheckOptions& options, Label outermost, const NestingHit& nearest) {
    if (nearest.distance == 0) return true;
    if (nearest.distance < HUGE_VAL)
        return nearest.label == outermost || (is_exterior(nearest.label) && is_exterior(outermost));
    return options.boundary_is_open || options.is_background(outermost) || is_exterior(outermost);
}

std::string nesting_text(const CheckOptions& options, std::uint32_t vertex, Label outermost,
                         const NestingHit& nearest) {
    const bool leaves = nearest.distance == HUGE_VAL;
    return "the part with vertex " + std::to_string(vertex) + " has faces that place it in " +
           region_name(options, outermost) + ", but " +
           (leaves ? "nothing surrounds it" : "it lies in " + region_name(options, nearest.label));
}

}  // namespace regionmesh
