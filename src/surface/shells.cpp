#include "surface/shells.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace regionmesh {
namespace {

/// A side of a face at an edge from a vertex to a neighbour.
struct SideAtEdge {
    VertexId neighbour;
    Label label;
    std::uint32_t side;
    VertexId apex;
    bool is_before;  // going round the edge, counter-clockwise seen from the neighbour, the label comes before the face
};

class SideJoiner {
public:
    SideJoiner(const Mesh& mesh, UnionFind& joined)
        : mesh_(mesh), joined_(joined), is_open_(std::size_t{2} * mesh.face_end()) {}

    std::vector<bool> run() {
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v)
            if (mesh_.is_alive(VertexId{v})) join_round(VertexId{v});
        return std::move(is_open_);
    }

private:
    /// Each edge is examined from its smaller end.
    void join_round(VertexId v) {
        sides_.clear();
        mesh_.for_star(v, [&](FaceId f, int place) {
            const Face& face = mesh_[f];
            const VertexId a = face.vertices[place_after(place)], b = face.vertices[place_before(place)];
            add(v, a, b, f, true);
            add(v, b, a, f, false);
        });
        std::ranges::sort(sides_, {}, [](const SideAtEdge& s) { return std::tuple(s.neighbour, s.label, s.side); });
        for (std::size_t first = 0, end = 0; first < sides_.size(); first = end) {
            const auto& [w, label, side, apex, before] = sides_[first];
            for (end = first; end < sides_.size() && sides_[end].neighbour == w && sides_[end].label == label;) ++end;
            join_edge(v, std::span(sides_).subspan(first, end - first));
        }
    }

    /// The normal of v, w, apex points in the direction in which the face would turn around the edge from v to w,
    /// toward its second label.
    void add(VertexId v, VertexId w, VertexId apex, FaceId f, bool has_order_of_face) {
        if (w < v) return;
        for (std::uint32_t k = 0; k < 2; ++k) {
            const std::uint32_t side = 2 * index(f) + k;
            sides_.push_back({w, label_of_side(mesh_, side), side, apex, (k == 0) == has_order_of_face});
        }
    }

    void join_edge(VertexId v, std::span<SideAtEdge> sides) {
        if (sides.size() == 1) is_open_[sides[0].side] = true;
        if (sides.size() == 2) joined_.join(sides[0].side, sides[1].side);
        if (sides.size() <= 2) return;
        sort_round(v, sides);
        for (std::size_t n = 0; n < sides.size(); ++n) {
            const SideAtEdge &here = sides[n], &next = sides[(n + 1) % sides.size()];
            if (!here.is_before && next.is_before) joined_.join(here.side, next.side);
        }
    }

    void sort_round(VertexId v, std::span<SideAtEdge> sides) const {
        const Vec3 from = mesh_.position(v), edge = mesh_.position(sides[0].neighbour) - from;
        const Vec3 start = mesh_.position(sides[0].apex) - from, across = cross(edge, start);
        const Vec3 ahead = cross(across, edge);
        const double scale = length(edge);
        const auto angle = [&](const SideAtEdge& side) {
            const Vec3 out = mesh_.position(side.apex) - from;
            return std::atan2(dot(out, across) * scale, dot(out, ahead));
        };
        std::ranges::stable_sort(sides, {}, angle);
    }

    const Mesh& mesh_;
    UnionFind& joined_;
    std::vector<bool> is_open_;
    std::vector<SideAtEdge> sides_;
};

}  // namespace

std::vector<bool> join_sides(const Mesh& mesh, UnionFind& joined) { return SideJoiner(mesh, joined).run(); }

}  // namespace regionmesh
