#include "regionmesh/box_axes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "mesh/alive.h"
#include "mesh/box_sides.h"
#include "mesh/extent.h"
#include "mesh/label_set.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

constexpr double kTolerance = 1e-6;  // share of the size of the box: files may be of single precision
constexpr double kParallel = 1e-3;   // small faces of such files are farther off than that

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

/// The mean normal of the faces with the exterior that are parallel to the largest one, of those taken.
template <class IsTaken>
std::optional<Vec3> main_normal(const Mesh& mesh, IsTaken&& is_taken) {
    Vec3 largest, sum;
    const auto visit = [&](auto&& take) {
        for_outer_faces(mesh, [&](FaceId f) {
            const Vec3 area = area_vector(mesh, f);
            if (is_taken(area)) take(area);
        });
    };
    visit([&](Vec3 area) {
        if (length2(area) > length2(largest)) largest = area;
    });
    visit([&](Vec3 area) {
        if (length(cross(area, largest)) <= kParallel * length(area) * length(largest))
            sum += dot(area, largest) < 0 ? -area : area;
    });
    if (length2(sum) == 0) return {};
    return sum / length(sum);
}

/// The normals of the sides of a box with right angles.
std::optional<std::array<Vec3, 3>> square_normals(const Mesh& mesh) {
    const auto u = main_normal(mesh, [](Vec3) { return true; });
    if (!u) return {};
    auto v = main_normal(mesh, [&](Vec3 area) { return std::abs(dot(area, *u)) <= kParallel * length(area); });
    if (!v) return {};
    v = *v - dot(*v, *u) * *u;
    v = *v / length(*v);
    return std::array{*u, *v, cross(*u, *v)};
}

/// Axes of any box with parallel sides: the largest faces of three directions.
std::optional<std::array<Vec3, 3>> any_normals(const Mesh& mesh) {
    std::array<Vec3, 3> normals;
    for (std::size_t n = 0; n < 3; ++n) {
        const auto found = main_normal(mesh, [&](Vec3 area) {
            return std::all_of(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(n),
                               [&](Vec3 known) { return length(cross(area, known)) > kParallel * length(area); });
        });
        if (!found) return {};
        normals[n] = *found;
    }
    if (std::abs(dot(cross(normals[0], normals[1]), normals[2])) < kParallel) return {};
    return normals;
}

[[noreturn]] void refuse_oblique(const std::string& what) {
    throw Error(ErrorCode::kUsage,
                what + " oblique; turn the mesh into its axes with BoxAxes, and restore it afterwards");
}

auto coordinates(Vec3 p) { return std::tuple(p.x, p.y, p.z); }

}  // namespace

/// Normal and area of a face with the exterior.
struct BoxAxes::Side {
    FaceId face;
    int side;
};

BoxAxes::BoxAxes(Mesh& mesh) {
    const Box along = extent_of(mesh, 1);
    bool is_along = true;
    for_outer_faces(mesh, [&](FaceId f) { is_along = is_along && sides_at(mesh.corners(f), along, 0) != 0; });
    if (is_along) return;
    // Axes that a file gives with few digits are not quite square. Where no face lies on the sides of a third axis, any
    // normals are those of slivers on other sides; only then, and where they do not fit, are right angles assumed.
    for (const bool is_square : {false, true}) {
        const auto normals = is_square ? square_normals(mesh) : any_normals(mesh);
        if (!normals) continue;
        set_axes(*normals);
        origin_ = 0.5 * (along.low + along.high);
        note_positions(mesh);
        Box box;
        for_vertices(mesh, [&](VertexId v) { box.add(after_[index(v)]); });
        if (turn(mesh, box, !is_square)) return;
    }
}

BoxAxes::BoxAxes(Mesh& mesh, const Lattice& lattice) {
    if (lattice.is_axis_aligned()) {
        samples_ = lattice;
        return;
    }
    set_axes(lattice);
    note_positions(mesh);
    if (!turn(mesh, samples_->extent(), false)) samples_.reset();
}

/// False, and nothing, where find_sides() says so.
bool BoxAxes::turn(Mesh& mesh, const Box& box, bool needs_all_axes) {
    const Vec3 size = box.high - box.low;
    const double tolerance = kTolerance * std::max({size.x, size.y, size.z});
    std::vector<Side> sides;
    const bool fits = find_sides(mesh, box, tolerance, needs_all_axes, sides);
    if (fits)
        put_on_box(mesh, box, tolerance, sides);
    else
        before_.clear(), after_.clear();
    return fits;
}

/// Each axis lies along an edge of the box, and takes the number of the coordinate that it is nearest to.
void BoxAxes::set_axes(const std::array<Vec3, 3>& normals) {
    std::array<Vec3, 3> along;
    for (std::size_t n = 0; n < 3; ++n) {
        const Vec3 edge = cross(normals[(n + 1) % 3], normals[(n + 2) % 3]);
        along[n] = edge / length(edge);
    }
    const auto [order, are_reversed] = axes_by_coordinate(along);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        axes_[axis] = are_reversed[axis] ? -along[order[axis]] : along[order[axis]];
        across_[axis] = normals[order[axis]] / dot(normals[order[axis]], axes_[axis]);
    }
}

/// The first sample along its axes becomes the origin. The axes are compared with the lattice's own: those that
/// set_axes() finds from normals are all reversed where the lattice mirrors.
void BoxAxes::set_axes(const Lattice& lattice) {
    const auto [x, y, z] = lattice.axes();
    set_axes({cross(y, z), cross(z, x), cross(x, y)});
    const auto [order, are_reversed] = axes_by_coordinate(lattice.axes());
    std::array<double, 3> first{};
    samples_ = Lattice{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t own = order[axis];
        samples_->size[axis] = lattice.size[own];
        samples_->spacing[static_cast<int>(axis)] = lattice.spacing[static_cast<int>(own)];
        if (are_reversed[axis]) first[own] = lattice.size[own] - 1.0;
    }
    origin_ = lattice.place_of(first);
}

void BoxAxes::note_positions(const Mesh& mesh) {
    before_.resize(mesh.vertex_end());
    after_.resize(mesh.vertex_end());
    for_vertices(mesh, [&](VertexId v) {
        const Vec3 from = mesh.position(v) - origin_;
        before_[index(v)] = mesh.position(v);
        after_[index(v)] = {dot(across_[0], from), dot(across_[1], from), dot(across_[2], from)};
    });
}

/// Whether each face with the exterior lies on a side, and few enough labels meet where two sides do; with
/// `needs_all_axes`, also whether each axis has a face that lies on its sides alone.
bool BoxAxes::find_sides(const Mesh& mesh, const Box& box, double tolerance, bool needs_all_axes,
                         std::vector<Side>& sides) const {
    bool is_box = true;
    std::array<bool, 3> has_face{};  // one per axis
    std::vector<SideSet> of_vertex(mesh.vertex_end());
    for_outer_faces(mesh, [&](FaceId f) {
        if (!is_box) return;
        std::array<Vec3, 3> corners;
        for (std::size_t n = 0; n < 3; ++n) corners[n] = after_[index(mesh[f].vertices[n])];
        const SideSet at = sides_at(corners, box, tolerance);
        is_box = is_box && at != 0;
        sides.push_back({f, std::countr_zero(at)});
        if (std::popcount(at) == 1) has_face[std::countr_zero(at) / 2] = true;
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
    return is_box && (!needs_all_axes || (has_face[0] && has_face[1] && has_face[2]));
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
        if (is_outer[index(v)] || (own & (kBoxSides | kOnHull)) != 0) {
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

void require_along_axes(const Mesh& mesh) {
    Box all;
    std::array<std::vector<double>, 6> of_side;  // coordinates across the sides
    for_vertices(mesh, [&](VertexId v) {
        const Vec3 p = mesh.position(v);
        all.add(p);
        for (std::size_t side = 0; side < 6; ++side)
            if (const double x = p[static_cast<int>(side / 2)]; mesh[v].sides >> side & 1 && std::isfinite(x))
                of_side[side].push_back(x);
    });
    const Vec3 size = all.high - all.low;
    const double tolerance = kTolerance * std::max({size.x, size.y, size.z});
    for (std::vector<double>& across : of_side) {
        if (across.empty()) continue;
        const auto middle = across.begin() + static_cast<std::ptrdiff_t>(across.size() / 2);
        std::nth_element(across.begin(), middle, across.end());
        const auto near =
            std::ranges::count_if(across, [&, at = *middle](double x) { return std::abs(x - at) <= tolerance; });
        if (2 * static_cast<std::size_t>(near) < across.size()) refuse_oblique("the box of the mesh is");
    }
}

void require_along_axes(const std::string& what, const Lattice& samples) {
    require_lattice(what, samples);
    if (!samples.is_axis_aligned()) refuse_oblique(what + ": the lattice is");
}

}  // namespace regionmesh
