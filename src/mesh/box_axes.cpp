#include "regionmesh/box_axes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "mesh/alive.h"
#include "mesh/box_sides.h"
#include "mesh/extent.h"
#include "mesh/label_set.h"

namespace regionmesh {
namespace {

constexpr double kTolerance = 1e-6;  // of the size of the box: files may be of single precision
constexpr double kParallel = 1e-3;   // small faces of such files are farther off than that
constexpr SideSet kPlanes = 0b111111;

template <class Visit>
void for_outer_faces(const Mesh& mesh, Visit&& visit) {
    for_faces(mesh, [&](FaceId f) {
        if (is_exterior(mesh[f].labels[1])) visit(f);
    });
}

Vec3 area_vector(const Mesh& mesh, FaceId f) {
    const auto [a, b, c] = mesh.corners(f);
    return cross(b - a, c - a);
}

/// The mean normal of the faces with the exterior that are parallel to the largest one, of those square to `u`.
std::optional<Vec3> main_normal(const Mesh& mesh, std::optional<Vec3> u) {
    Vec3 largest, sum;
    const auto visit = [&](auto&& take) {
        for_outer_faces(mesh, [&](FaceId f) {
            const Vec3 area = area_vector(mesh, f);
            if (!u || std::abs(dot(area, *u)) <= kParallel * length(area)) take(area);
        });
    };
    visit([&](Vec3 area) {
        if (length2(area) > length2(largest)) largest = area;
    });
    visit([&](Vec3 area) {
        if (length(cross(area, largest)) <= kParallel * length(area) * length(largest))
            sum += dot(area, largest) < 0 ? -area : area;
    });
    if (u) sum = sum - dot(sum, *u) * *u;
    if (length2(sum) == 0) return {};
    return sum / length(sum);
}

auto coordinates(Vec3 p) { return std::tuple(p.x, p.y, p.z); }

}  // namespace

/// Of a face with the exterior.
struct BoxAxes::Side {
    FaceId face;
    int side;
};

BoxAxes::BoxAxes(Mesh& mesh) {
    const Box along = extent_of(mesh, 1);
    bool is_along = true;
    for_outer_faces(mesh, [&](FaceId f) { is_along = is_along && sides_at(mesh.corners(f), along, 0) != 0; });
    if (is_along || !find_axes(mesh)) return;
    note_positions(mesh);
    Box box;
    for_vertices(mesh, [&](VertexId v) { box.add(after_[index(v)]); });
    const Vec3 size = box.high - box.low;
    const double tolerance = kTolerance * std::max({size.x, size.y, size.z});
    std::vector<Side> sides;
    if (find_sides(mesh, box, tolerance, sides))
        put_on_box(mesh, box, tolerance, sides);
    else
        before_.clear(), after_.clear();
}

/// Each axis takes the number of the coordinate that it is nearest to.
bool BoxAxes::find_axes(const Mesh& mesh) {
    const auto u = main_normal(mesh, {});
    const auto v = u ? main_normal(mesh, u) : std::nullopt;
    if (!v) return false;
    std::vector<Vec3> left{*u, *v, cross(*u, *v)};
    for (int axis = 0; axis < 3; ++axis) {
        const auto nearest = std::ranges::max_element(left, {}, [&](Vec3 a) { return std::abs(a[axis]); });
        axes_[static_cast<std::size_t>(axis)] = (*nearest)[axis] < 0 ? -*nearest : *nearest;
        left.erase(nearest);
    }
    if (dot(cross(axes_[0], axes_[1]), axes_[2]) < 0) axes_[2] = -axes_[2];
    return true;
}

void BoxAxes::note_positions(const Mesh& mesh) {
    const Box extent = extent_of(mesh, 1);
    origin_ = 0.5 * (extent.low + extent.high);
    before_.resize(mesh.vertex_end());
    after_.resize(mesh.vertex_end());
    for_vertices(mesh, [&](VertexId v) {
        const Vec3 from = mesh.position(v) - origin_;
        before_[index(v)] = mesh.position(v);
        after_[index(v)] = {dot(axes_[0], from), dot(axes_[1], from), dot(axes_[2], from)};
    });
}

/// Whether each face with the exterior lies on a side, and few enough labels meet where two sides do.
bool BoxAxes::find_sides(const Mesh& mesh, const Box& box, double tolerance, std::vector<Side>& sides) const {
    bool is_box = true;
    std::vector<SideSet> of_vertex(mesh.vertex_end());
    for_outer_faces(mesh, [&](FaceId f) {
        std::array<Vec3, 3> corners;
        for (std::size_t n = 0; n < 3; ++n) corners[n] = after_[index(mesh[f].vertices[n])];
        const SideSet at = sides_at(corners, box, tolerance);
        is_box = is_box && at != 0;
        sides.push_back({f, std::countr_zero(at)});
        for (const VertexId v : mesh[f].vertices) of_vertex[index(v)] |= static_cast<SideSet>(at & -at);
    });
    for_vertices(mesh, [&](VertexId v) {
        if (!is_box || std::popcount(of_vertex[index(v)]) < 2) return;
        LabelSet labels;
        mesh.for_star(v, [&](FaceId f, int) {
            for (const Label label : mesh[f].labels)
                if (!is_exterior(label)) labels.add(label);
        });
        is_box = may_meet(labels.size(), of_vertex[index(v)]);
    });
    return is_box;
}

/// Makes the mesh anew: faces keep their labels while they are in a mesh.
void BoxAxes::put_on_box(Mesh& mesh, const Box& box, double tolerance, const std::vector<Side>& sides) {
    std::vector<bool> is_outer(mesh.vertex_end());
    for (const auto& [face, side] : sides)
        for (const VertexId v : mesh[face].vertices) is_outer[index(v)] = true;
    Mesh turned;
    turned.reserve(mesh.vertex_count(), mesh.face_count());
    std::vector<VertexId> made(mesh.vertex_end());
    for_vertices(mesh, [&](VertexId v) {
        const Vertex& vertex = mesh[v];
        Vec3& p = after_[index(v)];
        SideSet own = vertex.sides;
        if (is_outer[index(v)] || (own & (kPlanes | kOnHull)) != 0) {
            const SideSet at = sides_at(std::span(&p, 1), box, tolerance);
            if (at != 0) own = static_cast<SideSet>((own & kPinned) | at);
            for (int plane = 0; plane < 6; ++plane)
                if (at >> plane & 1) p[plane / 2] = (plane % 2 == 0 ? box.low : box.high)[plane / 2];
        }
        sorted_.push_back(index(v));
        made[index(v)] = turned.add_vertex(p, own, vertex.is_fixed);
        turned[made[index(v)]].set_error_bound(vertex.error_bound());
    });
    auto next = sides.begin();
    for_faces(mesh, [&](FaceId f) {
        const auto [a, b, c] = mesh[f].vertices;
        auto [first, second] = mesh[f].labels;
        if (next != sides.end() && next->face == f) second = exterior((next++)->side);
        turned.add_face(made[index(a)], made[index(b)], made[index(c)], first, second);
    });
    mesh = std::move(turned);
    std::ranges::sort(sorted_, {}, [&](std::uint32_t n) { return coordinates(after_[n]); });
}

void BoxAxes::restore(Mesh& mesh) const {
    if (!is_oblique()) return;
    for_vertices(mesh, [&](VertexId v) {
        Vec3& p = mesh[v].position;
        const auto same = std::ranges::lower_bound(sorted_, coordinates(p), {},
                                                   [&](std::uint32_t n) { return coordinates(after_[n]); });
        p = same != sorted_.end() && after_[*same] == p ? before_[*same]
                                                        : origin_ + p.x * axes_[0] + p.y * axes_[1] + p.z * axes_[2];
    });
}

}  // namespace regionmesh
