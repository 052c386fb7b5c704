#include "surface/line_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regionmesh {
namespace {

/// Faces on lines count where an interface has fewer others within reach.
constexpr std::size_t kFewest = 4;

/// Faces count that are up to so many mean lengths of edges of lines away. More is better for planes, and fewer for
/// curved interfaces: with 12, two bubbles of 9 samples, of a tenth of their faces, get 9 instead of 2 degrees of
/// error, and sectors of 120 degrees 1.1 instead of 1.3.
constexpr double kReach = 8, kReachWhereRough = 14;

/// Surfaces are rough, as before smoothing, where half of the fits have a larger mean square error. Without smoothing
/// it is 0.1 to 0.2, with it 0.001, and 0.1 only where a thin wedge ends.
constexpr double kRough = 0.05;

/// Normals are fitted so often, but once where surfaces are rough.
constexpr int kRounds = 6;

/// Edges that are looked at to tell.
constexpr std::size_t kTrials = 200;

/// Interfaces that make smaller angles with each other have no direction in common.
constexpr double kLeastSine = 0.1;

/// Faces of an interface that count, at most: where an edge is long, many may lie within reach.
constexpr std::size_t kMostFaces = 1000;

constexpr double kFullTurn = 2 * std::numbers::pi;

/// Angle from -pi to pi; none where a direction has no length.
std::optional<double> angle_about(Vec3 axis, Vec3 from, Vec3 to) {
    const double x = dot(from, to), y = dot(cross(from, to), axis);
    if (!std::isfinite(x) || !std::isfinite(y) || (x == 0 && y == 0)) return std::nullopt;
    return std::atan2(y, x);
}

}  // namespace

LineAngles::LineAngles(const FileView& view, const std::vector<bool>& on_line, double edge_length)
    : view_(view),
      mesh_(view.mesh()),
      on_line_(on_line),
      edge_length_(edge_length),
      reach_(kReach * edge_length),
      rounds_(kRounds),
      seen_(mesh_.face_end()) {}

void LineAngles::look_at(std::span<const std::array<VertexId, 2>> edges) {
    std::vector<double> errors;
    for (std::size_t n = 0; n < edges.size(); n += 1 + edges.size() / kTrials) {
        find_planes(edges[n][0], edges[n][1]);
        for (const Plane& plane : planes_)  // sides of the box are flat
            if (std::ranges::max(plane.ranks) < kFirstExterior) errors.push_back(plane.error);
    }
    if (errors.empty()) return;
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    if (*middle <= kRough) return;
    reach_ = kReachWhereRough * edge_length_;
    rounds_ = 1;
}

const std::vector<std::optional<double>>& LineAngles::at_edge(VertexId v, VertexId w,
                                                              std::span<const std::uint32_t> ranks) {
    find_planes(v, w);
    angles_.clear();
    turns_.clear();
    for (const std::uint32_t rank : ranks) {
        const std::optional<Turn> turn = turn_inside(rank);
        angles_.push_back(turn ? std::optional(turn->angle) : std::nullopt);
        if (turn) turns_.push_back(*turn);
    }
    if (turns_.size() < ranks.size()) return angles_;
    // Exchanged interfaces: the angle that is farthest from that of the faces gets a full turn less, or more.
    double sum = 0;
    for (const Turn& turn : turns_) sum += turn.angle;
    for (long extra = std::lround(sum / kFullTurn) - 1; extra != 0; extra += extra < 0 ? 1 : -1) {
        const double sign = extra < 0 ? -1 : 1;
        const auto farthest =
            std::ranges::max_element(turns_, {}, [&](const Turn& turn) { return sign * (turn.angle - turn.of_faces); });
        farthest->angle -= sign * kFullTurn;
        angles_[farthest - turns_.begin()] = farthest->angle;
    }
    return angles_;
}

void LineAngles::find_planes(VertexId v, VertexId w) {
    planes_.clear();
    was_well_seen_ = true;
    const Vec3 from = mesh_.position(v), edge = mesh_.position(w) - from;
    along_ = (1 / length(edge)) * edge;
    mesh_.for_star(v, [&](FaceId f, int place) {
        const Face& face = mesh_[f];
        const VertexId after = face.vertices[(place + 1) % 3], before = face.vertices[(place + 2) % 3];
        if (after != w && before != w) return;
        const Vec3 side = mesh_.position(after == w ? before : after) - from;
        find_faces_near(f, from + 0.5 * edge);
        const bool is_well_seen = off_line_.size() >= kFewest;
        was_well_seen_ = was_well_seen_ && is_well_seen;
        const auto [normal, error] = fit_normal(is_well_seen ? off_line_ : near_, reach_, rounds_);
        planes_.push_back({{view_.rank(face.labels[0]), view_.rank(face.labels[1])},
                           normal,
                           error,
                           side - dot(side, along_) * along_,
                           after == w});
    });
    axis_ = axis_of(along_);
    for (Plane& plane : planes_)
        plane.away = plane.is_second_onward ? cross(plane.normal, axis_) : cross(axis_, plane.normal);
}

/// Faces of one interface that are joined to the first, the nearest first.
void LineAngles::find_faces_near(FaceId at_edge, Vec3 middle) {
    const std::array<Label, 2> labels = mesh_[at_edge].labels;
    near_.clear();
    off_line_.clear();
    ++search_;
    seen_[index(at_edge)] = search_;
    found_ = {at_edge};
    for (std::size_t n = 0; n < found_.size() && near_.size() < kMostFaces; ++n) {
        const FaceId f = found_[n];
        const auto [a, b, c] = mesh_.corners(f);
        const Vec3 at = (1.0 / 3) * (a + b + c) - middle, normal = cross(b - a, c - a);
        if (f != at_edge && length(at) >= reach_) continue;
        if (const double area = length(normal); area > 0) {
            near_.push_back({at, (1 / area) * normal, area});
            if (std::ranges::none_of(mesh_[f].vertices, [&](VertexId v) { return on_line_[index(v)]; }))
                off_line_.push_back(near_.back());
        }
        for (const VertexId v : mesh_[f].vertices)
            mesh_.for_star(v, [&](FaceId next, int) {
                if (seen_[index(next)] == search_ || !mesh_[next].has_labels(labels)) return;
                seen_[index(next)] = search_;
                found_.push_back(next);
            });
    }
}

/// The direction that the interfaces have in common; that of the edge where they are nearly parallel.
Vec3 LineAngles::axis_of(Vec3 along) const {
    Vec3 axis{};
    for (std::size_t n = 0; n < planes_.size(); ++n)
        for (std::size_t m = 0; m < n; ++m) {
            const double size = length(planes_[n].normal) * length(planes_[m].normal);
            const Vec3 common = cross(planes_[n].normal, planes_[m].normal);
            if (size > 0) axis += (dot(common, along) < 0 ? -1 / size : 1 / size) * common;
        }
    if (!(length(axis) > kLeastSine)) axis = along;
    return (1 / length(axis)) * axis;
}

std::optional<LineAngles::Turn> LineAngles::turn_inside(std::uint32_t rank) const {
    std::array<const Plane*, 2> sides;
    int count = 0;
    for (const Plane& plane : planes_) {
        const bool is_first = plane.ranks[0] == rank, is_second = plane.ranks[1] == rank;
        if (!is_first && !is_second) continue;
        if (count == 2 || (is_first && is_second)) return std::nullopt;
        sides[count++] = &plane;
    }
    if (count != 2) return std::nullopt;
    const auto& [from, to] = sides;
    const double sign = from->is_second_onward == (from->ranks[1] == rank) ? 1 : -1;
    const auto angle = angle_about(axis_, from->away, to->away);
    const auto of_faces = angle_about(along_, from->in_face, to->in_face);
    if (!angle || !of_faces) return std::nullopt;
    const auto from_0 = [&](double turn) { return sign * turn < 0 ? sign * turn + kFullTurn : sign * turn; };
    return Turn{from_0(*angle), from_0(*of_faces)};
}

}  // namespace regionmesh
