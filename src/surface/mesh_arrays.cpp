#include "regionmesh/mesh_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <string>

#include "mesh/box_sides.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "surface/assemble.h"
#include "surface/file_view.h"

namespace regionmesh {
namespace {

using Corners = std::array<std::uint32_t, 3>;

[[noreturn]] void refuse(const std::string& text) { throw Error(ErrorCode::kInput, "arrays: " + text); }

void require_consistent(const MeshArrays& arrays) {
    const std::size_t points = arrays.points.size(), faces = arrays.faces.size();
    require_mesh_size("arrays", points, faces);
    if (arrays.labels.size() != faces)
        refuse(std::to_string(faces) + " faces, but " + std::to_string(arrays.labels.size()) +
               " pairs of labels; give one pair for each face");
    if (!arrays.node_types.empty() && arrays.node_types.size() != points)
        refuse(std::to_string(points) + " points, but " + std::to_string(arrays.node_types.size()) +
               " node types; give one for each point, or none");
    for (std::size_t n = 0; n < points; ++n)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(arrays.points[n][axis]))
                refuse("point " + std::to_string(n) + " is not finite; give three numbers");
    for (std::size_t f = 0; f < faces; ++f)
        for (const std::uint32_t v : arrays.faces[f])
            if (v >= points)
                refuse("face " + std::to_string(f) + " names point " + std::to_string(v) + " of " +
                       std::to_string(points) + "; count points from 0");
}

Box bounding_box(const MeshArrays& arrays) {
    Box box;
    for (const Corners& face : arrays.faces)
        for (const std::uint32_t v : face) box.add(arrays.points[v]);
    return box;
}

/// The sides of the box whose planes contain all the points, exactly.
SideSet sides_of(const MeshArrays& arrays, std::span<const std::uint32_t> points, const Box& box) {
    return sides_at(points | std::views::transform([&](std::uint32_t v) { return arrays.points[v]; }), box, 0);
}

std::optional<int> side_of_face(const MeshArrays& arrays, const Corners& face, const Box& box) {
    const SideSet sides = sides_of(arrays, face, box);
    return sides == 0 ? std::nullopt : std::optional(std::countr_zero(sides));
}

/// Do all faces to the exterior lie in planes of the box, and do at most four labels, sides included, meet on its edges
/// and corners? Otherwise the lattice was oblique, or cells of a mesh had the labels.
bool exterior_is_box(const MeshArrays& arrays, const Box& box) {
    std::vector<SideSet> sides(arrays.points.size());
    for (std::size_t f = 0; f < arrays.faces.size(); ++f) {
        if (std::ranges::count(arrays.labels[f], arrays.exterior_label) == 0) continue;
        const auto side = side_of_face(arrays, arrays.faces[f], box);
        if (!side) return false;
        for (const std::uint32_t v : arrays.faces[f]) sides[v] |= static_cast<SideSet>(1u << *side);
    }
    const auto is_on_edge = [&](std::uint32_t v) { return (sides[v] & (sides[v] - 1)) != 0; };
    // Vertices on edges of the box are few, so a map is cheap.
    std::map<std::uint32_t, std::set<InputLabel>> labels_of;
    for (std::uint32_t v = 0; v < sides.size(); ++v)
        if (is_on_edge(v)) labels_of[v];
    for (std::size_t f = 0; f < arrays.faces.size(); ++f)
        for (const std::uint32_t v : arrays.faces[f])
            if (is_on_edge(v))
                for (const InputLabel label : arrays.labels[f])
                    if (label != arrays.exterior_label) labels_of[v].insert(label);
    return std::ranges::all_of(
        labels_of, [&](const auto& item) { return may_meet(static_cast<int>(item.second.size()), sides[item.first]); });
}

/// Do all points of types on the box lie in its planes? Those of an open model of an oblique volume do not.
bool rims_are_on_box(const MeshArrays& arrays, const Box& box) {
    for (std::uint32_t v = 0; v < arrays.node_types.size(); ++v)
        if (arrays.node_types[v] >= kFirstHullType && sides_of(arrays, {&v, 1}, box) == 0) return false;
    return true;
}

/// Does a label end at faces with the exterior, and has none itself? So does background on a hull that is no box.
bool has_rims_on_hull(const MeshArrays& arrays) {
    const auto is_outer = [&](std::size_t f) {
        return std::ranges::count(arrays.labels[f], arrays.exterior_label) > 0;
    };
    std::set<InputLabel> on_hull{arrays.exterior_label};
    for (std::size_t f = 0; f < arrays.faces.size(); ++f)
        if (is_outer(f)) on_hull.insert(arrays.labels[f].begin(), arrays.labels[f].end());
    const auto ends = [&](std::size_t f) {
        return std::ranges::any_of(arrays.labels[f], [&](InputLabel label) { return !on_hull.contains(label); });
    };
    struct Use {
        std::uint32_t low, high, face;
        auto operator<=>(const Use&) const = default;
    };
    const auto all = std::views::iota(std::uint32_t{0}, static_cast<std::uint32_t>(arrays.faces.size()));
    if (std::ranges::none_of(all, ends)) return false;
    std::vector<Use> uses;
    for (const std::uint32_t f : all) {
        if (!is_outer(f) && !ends(f)) continue;
        for (int n = 0; n < 3; ++n) {
            const auto [low, high] = std::minmax(arrays.faces[f][n], arrays.faces[f][(n + 1) % 3]);
            uses.push_back({low, high, f});
        }
    }
    std::ranges::sort(uses);
    for (std::size_t first = 0, end = 1; first < uses.size(); first = end++) {
        while (end < uses.size() && uses[end].low == uses[first].low && uses[end].high == uses[first].high) ++end;
        if (end - first != 2) continue;
        const std::uint32_t f = uses[first].face, g = uses[first + 1].face;
        if ((is_outer(f) && ends(g)) || (is_outer(g) && ends(f))) return true;
    }
    return false;
}

/// An edge with one face, which lies between two regions; both ends are on the hull.
struct OpenEdge {
    VertexId a, b;
    SideSet planes;  // planes of the box in which the edge lies and the face does not
};

std::vector<OpenEdge> find_open_edges(const Mesh& mesh, const MeshArrays& arrays, const Box& box) {
    const auto is_on_hull = [&](VertexId v) { return arrays.node_types[index(v)] >= kFirstHullType; };
    std::vector<OpenEdge> edges;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const Face& face = mesh[FaceId{f}];
        if (is_exterior(face.labels[0]) || is_exterior(face.labels[1])) continue;
        for (int place = 0; place < 3; ++place) {
            const VertexId a = face.vertices[place], b = face.vertices[place_after(place)];
            if (!is_on_hull(a) || !is_on_hull(b)) continue;
            int faces = 0;
            mesh.for_star(a, [&](FaceId g, int) { faces += std::ranges::count(mesh[g].vertices, b) > 0; });
            if (faces != 1) continue;
            const SideSet of_edge = sides_of(arrays, std::array{index(a), index(b)}, box),
                          of_face = sides_of(arrays, arrays.faces[f], box);
            edges.push_back({a, b, static_cast<SideSet>(of_edge & ~of_face)});
        }
    }
    return edges;
}

/// Both regions background, or no side capped: an interface ends on a side of the box, in
/// edges with one face: their ends lie on that side, too. `box` is that of the points, and interfaces need not reach
/// all sides: one of its planes is known to be a side where it has capped faces, or an open edge that lies in no other
/// plane. An edge lies on the known sides among its planes, or on all of them if none is known.
void mark_open_rims(LabelledMesh& made, const MeshArrays& arrays, const Box& box) {
    Mesh& mesh = made.mesh;
    const std::vector<OpenEdge> edges = find_open_edges(mesh, arrays, box);
    SideSet known = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) known |= mesh[VertexId{v}].sides;
    for (const OpenEdge& edge : edges)
        if (std::has_single_bit(edge.planes)) known |= edge.planes;
    for (const auto& [a, b, planes] : edges) {
        const auto among_known = static_cast<SideSet>(planes & known);
        for (const VertexId v : {a, b}) mesh[v].sides |= among_known != 0 ? among_known : planes;
    }
    // A rim on one side may touch another one.
    const FileView view(mesh, made.labels, {});
    for (std::uint32_t v = 0; v < arrays.node_types.size(); ++v)
        if (mesh[VertexId{v}].sides != 0 && view.node_type(VertexId{v}) < arrays.node_types[v])
            mesh[VertexId{v}].sides |= static_cast<SideSet>(sides_of(arrays, {&v, 1}, box) & known);
}

}  // namespace

LabelledMesh assemble(const MeshArrays& arrays) {
    LabelledMesh made{.mesh = {}, .labels = LabelTable(arrays.is_unsigned)};
    Mesh& mesh = made.mesh;
    mesh.reserve(arrays.points.size(), arrays.faces.size());
    for (const Vec3& point : arrays.points) mesh.add_vertex(point);
    const Box box = bounding_box(arrays);
    const bool has_sides = exterior_is_box(arrays, box) && rims_are_on_box(arrays, box);
    const bool has_hull = !has_sides && (!arrays.node_types.empty() || has_rims_on_hull(arrays));
    for (std::size_t f = 0; f < arrays.faces.size(); ++f) {
        std::array<Label, 2> labels;
        for (int i = 0; i < 2; ++i) {
            const InputLabel label = arrays.labels[f][i];
            if (label != arrays.exterior_label) {
                labels[i] = made.labels.dense(label);
                continue;
            }
            if (!has_sides) {
                labels[i] = exterior(has_hull ? kHull : 0);
                if (has_hull && arrays.node_types.empty())
                    for (const std::uint32_t v : arrays.faces[f]) mesh[VertexId{v}].sides = kOnHull;
                continue;
            }
            const int side = *side_of_face(arrays, arrays.faces[f], box);
            labels[i] = exterior(side);
            for (const std::uint32_t v : arrays.faces[f]) mesh[VertexId{v}].sides |= static_cast<SideSet>(1u << side);
        }
        const auto& [a, b, c] = arrays.faces[f];
        mesh.add_face(VertexId{a}, VertexId{b}, VertexId{c}, labels[0], labels[1]);
    }
    if (has_sides && !arrays.node_types.empty()) mark_open_rims(made, arrays, box);
    // A vertex without a face on a side of the box may lie on a side that is not capped, or on a hull of another shape.
    for (std::uint32_t v = 0; v < arrays.node_types.size(); ++v)
        if (arrays.node_types[v] >= kFirstHullType && mesh[VertexId{v}].sides == 0) mesh[VertexId{v}].sides = kOnHull;
    if (!has_sides) BoxAxes(mesh).restore(mesh);  // restore() finds the sides of an oblique box
    return made;
}

LabelledMesh import_arrays(const MeshArrays& arrays) {
    require_consistent(arrays);
    if (!arrays.faces.empty()) require_extent("arrays", bounding_box(arrays));
    return assemble(arrays);
}

MeshArrays export_arrays(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background) {
    require_labels(mesh, labels, "mesh");
    const FileView view(mesh, labels, background);
    MeshArrays arrays{.exterior_label = view.exterior_label(), .is_unsigned = labels.is_unsigned()};
    arrays.points.reserve(mesh.vertex_count());
    arrays.node_types.reserve(mesh.vertex_count());
    view.for_vertices([&](VertexId v) {
        arrays.points.push_back(mesh.position(v));
        arrays.node_types.push_back(view.node_type(v));
    });
    arrays.faces.reserve(mesh.face_count());
    arrays.labels.reserve(mesh.face_count());
    view.for_faces([&](FaceId f) {
        const FileFace face = view.face(f);
        arrays.faces.push_back(face.vertices);
        arrays.labels.push_back(face.labels);
    });
    return arrays;
}

}  // namespace regionmesh
