// The test of nesting, for one separate part of a surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "base/box.h"
#include "base/triangle.h"
#include "check/findings.h"

namespace regionmesh {

/// No simple ratios, so that a ray from a lattice point hits no edge.
inline constexpr Vec3 kNestingRay{1, 0.013748231, 0.007193377};

/// Sixfold volumes of the regions inside a separate part. That of its outermost region is negative, and no other.
using NestedVolumes = std::map<Label, double>;

inline void add_volume(NestedVolumes& volumes, const Mesh& mesh, FaceId f, Vec3 origin) {
    const auto& labels = mesh[f].labels;
    const auto p = mesh.corners(f);
    const double sixfold = dot(p[0] - origin, area_vector(p[0], p[1], p[2]));
    volumes[labels[0]] += sixfold;
    volumes[labels[1]] -= sixfold;
}

Label outermost(const NestedVolumes& volumes);

/// The nearest face on the way of a ray.
struct NestingHit {
    double distance = HUGE_VAL;
    Label label = 0;  // label of the region in front of the face
};

/// Distance of a point to a face along a ray (Moeller and Trumbore 1997); 0: the point is on the face.
NestingHit nesting_hit(const Mesh& mesh, FaceId f, Vec3 from);

/// Calls search(Box) for pieces of the way of a ray, each as long as all before it, until one of them holds `nearest`,
/// which it sets. Most parts lie close to what surrounds them, and the box of a whole way holds many faces.
template <class Search>
void search_along(Vec3 from, double reach, const NestingHit& nearest, Search&& search) {
    constexpr double kFirstPiece = 1.0 / 256;
    double at = 0;
    for (double end = reach * kFirstPiece; at < reach && nearest.distance > at; at = end, end *= 2) {
        Box box;
        box.add(from + at * kNestingRay);
        box.add(from + std::min(end, reach) * kNestingRay);
        search(box);
    }
}

/// Whether a part may lie where the ray from its farthest vertex says. One that touches another part there may: that is
/// a violation of another kind.
bool is_nested(const CheckOptions& options, Label outermost, const NestingHit& nearest);

/// The sentence about a part that does not lie where its faces say.
std::string nesting_text(const CheckOptions& options, std::uint32_t vertex, Label outermost, const NestingHit& nearest);

}  // namespace regionmesh
