#include "judge/verdict/rising_faces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lanes.h"
#include "judge/tuning.h"

namespace regionmesh {
namespace {

/// Half of the directions, one a lane; the last three lanes have none.
constexpr float kTwo = 0.70710678f, kThree = 0.57735027f;  // of two and three equal coordinates
constexpr std::array<Lanes3<Float4>, 4> kHalf{{
    {{1, 0, 0, kTwo}, {0, 1, 0, kTwo}, {0, 0, 1, 0}},
    {{kTwo, kTwo, kTwo, 0}, {-kTwo, 0, 0, kTwo}, {0, kTwo, -kTwo, kTwo}},
    {{0, kThree, kThree, kThree}, {kTwo, kThree, kThree, -kThree}, {-kTwo, kThree, -kThree, kThree}},
    {{-kThree, 0, 0, 0}, {kThree, 0, 0, 0}, {kThree, 0, 0, 0}},
}};

/// None for a needle, whose normal rounding may have turned: `size2` is the square of a length that no edge exceeds.
Directions rising(Vec3 normal, double length2, double size2) {
    constexpr double kNeedle = 1e-16;
    if (!(length2 > kNeedle * size2 * size2)) return 0;
    const double unit = 1 / std::sqrt(length2);
    const Float4 x = all_four(static_cast<float>(unit * normal.x)), y = all_four(static_cast<float>(unit * normal.y)),
                 z = all_four(static_cast<float>(unit * normal.z));
    const Float4 least = all_four(kLeastRise);
    Directions directions = 0;
    for (int n = 0; n < 4; ++n) {
        const Float4 rise = kHalf[n].x * x + kHalf[n].y * y + kHalf[n].z * z;
        directions |= bits_of(rise > least) << (4 * n) | bits_of(-rise > least) << (4 * n + 16);
    }
    return directions;
}

double size2_of(const EdgeStar& star, Vec3 position) {
    const Box& box = star.link_box;
    return length2(max(box.high, position) - min(box.low, position));
}

}  // namespace

void RisingFaces::build(const Mesh& mesh) {
    directions_.assign(mesh.face_end(), 0);
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto p = mesh.corners(FaceId{f});
        const Vec3 u = p[1] - p[0], v = p[2] - p[0], normal = cross(u, v);
        directions_[f] = rising(normal, length2(normal), length2(u) + length2(v));
    }
}

void RisingFaces::set(const EdgeStar& star, Vec3 position) {
    const double size2 = size2_of(star, position);
    for (int n = 0; n < star.face_count(); ++n)
        directions_[index(star.faces[n].face)] = rising(star.new_normal(n), star.new_length2(n), size2);
}

Directions RisingFaces::common(const EdgeStar& star, Vec3 position) const {
    Directions all = ~0u;
    for (const StarFace& face : star.faces) all &= directions_[index(face.face)];
    for (FaceId f : star.dead) all &= directions_[index(f)];
    const double size2 = size2_of(star, position);
    for (int n = 0; n < star.face_count() && all != 0; ++n)
        all &= rising(star.new_normal(n), star.new_length2(n), size2);
    return all;
}

}  // namespace regionmesh
