#include "regionmesh/box_axes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "mesh/extent.h"

namespace regionmesh {
namespace {

constexpr double kTolerance = 1e-6;  // of the size of the box: files may be of single precision
constexpr SideSet kPlanes = 0b111111;

template <class Visit>
void for_outer_faces(const Mesh& mesh, Visit&& visit) {
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        if (mesh.is_alive(FaceId{f}) && is_exterior(mesh[FaceId{f}].labels[1])) visit(FaceId{f});
}

Vec3 area_vector(const Mesh& mesh, FaceId f) {
    const auto [a, b, c] = mesh.corners(f);
    return cross(b - a, c - a);
}

/// The sides of the box whose planes contain all the points, within the tolerance.
SideSet sides_at(std::span<const Vec3> points, const Box& box, double tolerance) {
    SideSet sides = 0;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double plane = (side % 2 == 0 ? box.low : box.high)[axis];
        if (std::ranges::all_of(points, [&](Vec3 p) { return std::abs(p[axis] - plane) <= tolerance; }))
            sides |= static_cast<SideSet>(1u << side);
    }
    return sides;
}

}  // namespace

BoxAxes::BoxAxes(Mesh& mesh) {
    const Box along = extent_of(mesh, 1);
    bool is_along = true;
    for_outer_faces(mesh, [&](FaceId f) { is_along = is_along && sides_at(mesh.corners(f), along, 0) != 0; });
    if (is_along || !find_axes(mesh)) return;
    note_positions(mesh);
    Box box;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) box.add(after_[v]);
    const Vec3 size = box.high - box.low;
    const double tolerance = kTolerance * std::max({size.x, size.y, size.z});
    std::vector<int> sides;
    if (find_sides(mesh, box, tolerance, sides))
        put_on_box(mesh, box, tolerance, sides);
    else
        before_.clear(), after_.clear();
}

/// From the largest face with the exterior, and the largest one square to it. Each axis takes the number of the
/// coordinate that it is nearest to.
bool BoxAxes::find_axes(const Mesh& mesh) {
    const auto largest = [&](std::optional<Vec3> square_to) {
        Vec3 best;
        for_outer_faces(mesh, [&](FaceId f) {
            const Vec3 area = area_vector(mesh, f);
            if (square_to && std::abs(dot(area, *square_to)) > kTolerance * length(area)) return;
            if (length2(area) > length2(best)) best = area;
        });
        return best;
    };
    const Vec3 first = largest({});
    if (length2(first) == 0) return false;
    const Vec3 u = first / length(first), second = largest(u);
    if (length2(second) == 0) return false;
    const Vec3 across = second - dot(second, u) * u, v = across / length(across);
    std::vector<Vec3> left{u, v, cross(u, v)};
    for (int axis = 0; axis < 3; ++axis) {
        const auto nearest = std::ranges::max_element(left, {}, [&](Vec3 a) { return std::abs(a[axis]); });
        axes_[static_cast<std::size_t>(axis)] = (*nearest)[axis] < 0 ? -*nearest : *nearest;
        left.erase(nearest);
    }
    if (dot(cross(axes_[0], axes_[1]), axes_[2]) < 0) axes_[2] = -axes_[2];
    return true;
}

Vec3 BoxAxes::turned(Vec3 p) const {
    const Vec3 from = p - origin_;
    return {dot(axes_[0], from), dot(axes_[1], from), dot(axes_[2], from)};
}

void BoxAxes::note_positions(const Mesh& mesh) {
    const Box extent = extent_of(mesh, 1);
    origin_ = 0.5 * (extent.low + extent.high);
    before_.resize(mesh.vertex_end());
    after_.resize(mesh.vertex_end());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        before_[v] = mesh.position(VertexId{v});
        after_[v] = turned(before_[v]);
    }
}

/// The side of each face with the exterior; false where one has none.
bool BoxAxes::find_sides(const Mesh& mesh, const Box& box, double tolerance, std::vector<int>& sides) const {
    bool is_box = true;
    for_outer_faces(mesh, [&](FaceId f) {
        std::array<Vec3, 3> corners;
        for (std::size_t n = 0; n < 3; ++n) corners[n] = after_[index(mesh[f].vertices[n])];
        const SideSet at = sides_at(corners, box, tolerance);
        is_box = is_box && at != 0;
        sides.push_back(std::countr_zero(at));
    });
    return is_box;
}

void BoxAxes::put_on_box(Mesh& mesh, const Box& box, double tolerance, const std::vector<int>& sides) {
    auto side = sides.begin();
    for_outer_faces(mesh, [&](FaceId f) {
        const Face face = mesh[f];
        const auto [a, b, c] = face.vertices;
        mesh.remove_face(f);
        mesh.add_face(a, b, c, face.labels[0], exterior(*side++));  // in the place that became free
        for (const VertexId v : face.vertices) mesh[v].sides |= kOnHull;
    });
    for (std::uint32_t n = 0; n < mesh.vertex_end(); ++n) {
        if (!mesh.is_alive(VertexId{n})) continue;
        Vertex& vertex = mesh[VertexId{n}];
        Vec3& p = vertex.position = after_[n];
        if ((vertex.sides & (kPlanes | kOnHull)) == 0) continue;
        const SideSet at = sides_at({&p, 1}, box, tolerance);
        if (at != 0) vertex.sides = static_cast<SideSet>((vertex.sides & kPinned) | at);
        for (int plane = 0; plane < 6; ++plane)
            if (at >> plane & 1) p[plane / 2] = (plane % 2 == 0 ? box.low : box.high)[plane / 2];
        after_[n] = p;
    }
}

void BoxAxes::restore(Mesh& mesh) const {
    if (!is_oblique()) return;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        Vec3& p = mesh[VertexId{v}].position;
        p = v < after_.size() && p == after_[v] ? before_[v]
                                                : origin_ + p.x * axes_[0] + p.y * axes_[1] + p.z * axes_[2];
    }
}

}  // namespace regionmesh
