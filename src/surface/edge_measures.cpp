#include "surface/edge_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "surface/line_angles.h"

namespace regionmesh {
namespace {

/// A face at an edge from v to w.
struct FaceAtEdge {
    VertexId w;
    FaceId face;
    int place;  // index of v in the face
};

/// An edge of a line, with its entry in EdgeMeasures::lines.
struct LineEdge {
    VertexId v, w;
    const std::vector<std::uint32_t>* ranks;
    LineMeasures* line;
};

/// Edges of a line whose angles are measured: more do not change the mean, and noise has lines of 200,000.
constexpr std::uint64_t kMostEdges = 1000;

/// Weight of edges at which an interface has hardly any face off lines (LineAngles::was_well_seen): they count where a
/// line has no others.
constexpr double kPoor = 1e-6;

class Measurer {
public:
    Measurer(const FileView& view, bool has_angles) : view_(view), mesh_(view.mesh()), has_angles_(has_angles) {}

    EdgeMeasures measure() {
        view_.for_faces([&](FaceId f) { add_face(f); });
        find_near_lines();
        std::vector<FaceAtEdge> around;
        view_.for_vertices([&](VertexId v) {
            around.clear();
            mesh_.for_star(v, [&](FaceId f, int place) {
                for (const int step : {1, 2})
                    if (const VertexId w = mesh_[f].vertices[(place + step) % 3]; v < w)
                        around.push_back({w, f, place});
            });
            std::ranges::sort(around, [](const FaceAtEdge& a, const FaceAtEdge& b) {
                return std::pair(a.w, a.face) < std::pair(b.w, b.face);
            });
            for (auto begin = around.begin(); begin != around.end();) {
                const auto end =
                    std::find_if(begin, around.end(), [&](const auto& other) { return other.w != begin->w; });
                add_edge(v, std::span(begin, end));
                begin = end;
            }
        });
        if (has_angles_ && !line_edges_.empty()) add_angles();
        return std::move(measures_);
    }

private:
    using Key = std::array<std::uint32_t, 2>;

    Key key_of(FaceId f) const {
        const auto [a, b] = mesh_[f].labels;
        return {std::min(view_.rank(a), view_.rank(b)), std::max(view_.rank(a), view_.rank(b))};
    }
    double area_of(FaceId f) const {
        const auto [a, b, c] = mesh_.corners(f);
        return 0.5 * length(cross(b - a, c - a));
    }
    /// No region: background or exterior.
    bool is_empty(std::uint32_t rank) const { return rank >= view_.region_ranks(); }

    void add_face(FaceId f) {
        const Key key = key_of(f);
        if (is_empty(key[0])) return;
        InterfaceMeasures& sums = measures_.interfaces[key];
        const auto [a, b, c] = mesh_.corners(f);
        const double area = area_of(f);
        ++sums.faces;
        sums.area += area;
        sums.moment += (area / 3) * (a + b + c);
    }

    /// Marks the vertices on lines and their neighbours.
    void find_near_lines() {
        on_line_.resize(mesh_.vertex_end());
        view_.for_vertices([&](VertexId v) {
            std::optional<Key> first;
            mesh_.for_star(v, [&](FaceId f, int) {
                const Key key = key_of(f);
                if (key != first.value_or(key)) on_line_[index(v)] = true;
                first = key;
            });
        });
        near_line_.resize(mesh_.vertex_end());
        view_.for_faces([&](FaceId f) {
            const auto& corners = mesh_[f].vertices;
            if (std::ranges::any_of(corners, [&](VertexId v) { return on_line_[index(v)]; }))
                for (const VertexId v : corners) near_line_[index(v)] = true;
        });
    }

    void add_edge(VertexId v, std::span<const FaceAtEdge> faces) {
        ranks_.clear();
        for (const FaceAtEdge& at : faces)
            for (const std::uint32_t rank : key_of(at.face)) ranks_.push_back(rank);
        std::ranges::sort(ranks_);
        ranks_.erase(std::unique(ranks_.begin(), ranks_.end()), ranks_.end());
        if (is_empty(ranks_[0])) return;
        const Vec3 along = mesh_.position(faces[0].w) - mesh_.position(v);
        if (ranks_.size() < 3) {
            if (ranks_.size() == 2 && ranks_[1] < kFirstExterior) add_curvature(v, along, faces);
            return;
        }
        add_line(v, along, faces);
    }

    /// A third of the area of a face belongs to each of its edges.
    void add_curvature(VertexId v, Vec3 along, std::span<const FaceAtEdge> faces) {
        if (near_line_[index(v)] || near_line_[index(faces[0].w)]) return;
        const auto angle = angle_inside(v, along, faces, ranks_[0]);
        if (!angle) return;
        InterfaceMeasures& sums = measures_.interfaces[{ranks_[0], ranks_[1]}];
        sums.curvature += 0.5 * length(along) * (std::numbers::pi - *angle);
        for (const FaceAtEdge& at : faces) sums.curved_area += area_of(at.face) / 3;
    }

    void add_line(VertexId v, Vec3 along, std::span<const FaceAtEdge> faces) {
        const double edge = length(along);
        auto& [ranks, line] = *measures_.lines.try_emplace(ranks_).first;
        ++line.edges;
        line.length += edge;
        if (has_angles_) line_edges_.push_back({v, faces[0].w, &ranks, &line});
        keys_.clear();
        for (const FaceAtEdge& at : faces) keys_.push_back(key_of(at.face));
        std::ranges::sort(keys_);
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
        for (const Key& key : keys_)
            if (!is_empty(key[0])) measures_.interfaces[key].line_length += edge;
    }

    /// Every n-th edge of a line with many edges.
    void add_angles() {
        double length_of_all = 0;
        for (auto& [ranks, line] : measures_.lines) {
            length_of_all += line.length;
            line.angles.resize(ranks.size());
            line.angle_length.resize(ranks.size());
        }
        LineAngles angles(view_, on_line_, length_of_all / static_cast<double>(line_edges_.size()));
        std::vector<std::array<VertexId, 2>> edges;
        for (const LineEdge& at : line_edges_) edges.push_back({at.v, at.w});
        angles.look_at(edges);
        std::map<const LineMeasures*, std::uint64_t> passed;
        for (const auto& [v, w, ranks, line] : line_edges_) {
            if (passed[line]++ % (1 + line->edges / kMostEdges) != 0) continue;
            const auto& at_edge = angles.at_edge(v, w, *ranks);
            const double edge = (angles.was_well_seen() ? 1 : kPoor) * length(mesh_.position(w) - mesh_.position(v));
            for (std::size_t n = 0; n < ranks->size(); ++n) {
                if ((*ranks)[n] >= kFirstExterior || !at_edge[n]) continue;
                line->angles[n] += edge * *at_edge[n];
                line->angle_length[n] += edge;
            }
        }
    }

    /// The dihedral angle of a label at the edge, from 0 to a full turn. None where it has not two faces there, or they
    /// have no area.
    std::optional<double> angle_inside(VertexId v, Vec3 along, std::span<const FaceAtEdge> faces,
                                       std::uint32_t rank) const {
        std::array<Vec3, 2> away;  // directions from the edge, in the face and across the edge
        Vec3 normal{};             // normal of the first face, out of the label
        int count = 0;
        for (const FaceAtEdge& at : faces) {
            const Face& face = mesh_[at.face];
            const bool is_first = view_.rank(face.labels[0]) == rank;
            if (!is_first && view_.rank(face.labels[1]) != rank) continue;
            if (count == 2 || (is_first && view_.rank(face.labels[1]) == rank)) return std::nullopt;
            const VertexId other = face.vertices[(at.place + 1) % 3] == at.w ? face.vertices[(at.place + 2) % 3]
                                                                             : face.vertices[(at.place + 1) % 3];
            const Vec3 side = mesh_.position(other) - mesh_.position(v);
            away[count] = side - (dot(side, along) / dot(along, along)) * along;
            if (count++ == 0) {
                const auto [a, b, c] = mesh_.corners(at.face);
                normal = (is_first ? 1.0 : -1.0) * cross(b - a, c - a);
            }
        }
        if (count != 2) return std::nullopt;
        const double size = length(normal);
        const double x = dot(away[0], away[1]), y = -dot(normal, away[1]) * length(away[0]) / size;
        if (!std::isfinite(x) || !std::isfinite(y) || (x == 0 && y == 0)) return std::nullopt;
        const double angle = std::atan2(y, x);
        return angle < 0 ? angle + 2 * std::numbers::pi : angle;
    }

    const FileView& view_;
    const Mesh& mesh_;
    bool has_angles_;
    EdgeMeasures measures_;
    std::vector<bool> on_line_, near_line_;  // one per vertex; near: joined by an edge to one on a line
    std::vector<std::uint32_t> ranks_;       // ranks of the labels at the edge
    std::vector<Key> keys_;                  // keys of its interfaces
    std::vector<LineEdge> line_edges_;
};

}  // namespace

EdgeMeasures measure_edges(const FileView& view, bool has_angles) { return Measurer(view, has_angles).measure(); }

}  // namespace regionmesh
