#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "mesh/strata.h"
#include "simplify/placement/placement.h"
#include "simplify/placement/quadric.h"
#include "simplify/tuning.h"

namespace regionmesh {
namespace {

constexpr bool has_side_of(SideSet sides, int axis) { return (sides >> (2 * axis) & 3) != 0; }

/// A linear constraint on the merged vertex: normal . p = offset.
struct Constraint {
    Label label;  // whose volume it keeps, or whose area
    int side;     // on this side of the box; -1 for the volume
    Vec3 normal;
    double offset;
    double size;  // sum of the sizes of the terms
};

/// Solves constraints one by one: each is met as far as those before leave it a direction.
class ConstrainedPoint {
public:
    void fix(int axis, double value) {
        Vec3 along;
        along[axis] = 1;
        meet(along, value, 1);
    }
    /// Left out where it is nearly dependent on those before, or where its terms nearly cancel.
    void meet(Vec3 normal, double offset, double size) {
        Vec3 rest = normal;
        for (int n = 0; n < count_; ++n) rest = rest - dot(basis_[n], rest) * basis_[n];
        const double left = length(rest);
        if (count_ == 3 || !(left > kLeastConstraintSine * length(normal)) || !(left > kLeastConstraintShare * size))
            return;
        const double step = (offset - dot(normal, point_)) / left;
        basis_[count_] = rest / left;
        point_ += step * basis_[count_++];
    }
    /// Where q and the squared distance to the origin times `pull` are least together, in the directions left.
    Vec3 least(const Quadric& q, double pull) {
        const Vec3 slope = -(q.times(point_) + q.b);
        complete_basis();
        const int free = 3 - count_;
        // Conjugate directions: Gram-Schmidt in the scalar product of the quadratic form.
        std::array<Vec3, 3> way;
        Vec3 step;
        for (int n = 0; n < free; ++n) {
            way[n] = basis_[count_ + n];
            const auto form = [&](Vec3 a, Vec3 b) { return dot(a, q.times(b)) + pull * dot(a, b); };
            for (int m = 0; m < n; ++m) way[n] = way[n] - form(way[m], way[n]) / form(way[m], way[m]) * way[m];
            const double curvature = form(way[n], way[n]);
            if (curvature > 0) step += dot(way[n], slope) / curvature * way[n];
        }
        return point_ + step;
    }

private:
    /// Fills in directions square to those taken.
    void complete_basis() {
        for (int filled = count_, axis = 0; filled < 3; ++axis) {
            Vec3 rest;
            rest[axis % 3] = 1;
            for (int n = 0; n < filled; ++n) rest = rest - dot(basis_[n], rest) * basis_[n];
            const double left = length(rest);
            if (left > 0.5 || (axis >= 3 && left > 1e-3)) basis_[filled++] = rest / left;
        }
    }

    std::array<Vec3, 3> basis_;  // orthonormal: directions taken, then free ones
    Vec3 point_;
    int count_ = 0;
};

/// Memoryless placement (Lindstrom and Turk 1998, section 4; 1999). The merged vertex keeps, in this order, the
/// coordinates of sides of the box; the volume of every region; and on a side of the box the area of every region. In
/// the directions left it takes the least sum of the squared volumes that faces sweep and the squared areas that edges
/// of lines sweep (times the squared length of the edge), drawn a little toward the middle of the edge instead of the
/// shape term of 1998. The cost is that sum. It grows with the square of a face's area; a face of typical area counts
/// like one in a quadric, so that thresholds mean about the same.
class LindstromTurk final : public Placement {
public:
    explicit LindstromTurk(double scale) : unit_(3 / (std::sqrt(3.0) / 4 * scale * scale)) {}

    void rank(const Mesh& mesh, VertexId v, std::span<const VertexId> to, std::vector<EdgeCost>& costs) override;
    void rank_halves(const Mesh& mesh, VertexId v, std::span<const VertexId> to, std::vector<HalfCost>& costs) override;
    Places place(const Mesh& mesh, const EdgeStar& star) override;
    void collapse(const Mesh&, const EdgeStar&, Vec3) override {}
    double prepass_cost() const override { return kPrepassVolumeCost; }
    std::size_t bytes() const override { return 0; }

private:
    struct Solution {
        Vec3 position;
        double cost, weight;
        Quadric quadric;  // relative to the middle of the edge
    };

    Solution solve(const Mesh& mesh, VertexId goes, VertexId stays);
    void begin(Vec3 origin) {
        origin_ = origin;
        volume_ = area_ = {};
        constraints_.clear();
        line_ends_.clear();
    }
    void add_star(const Mesh& mesh, VertexId v, VertexId except);
    void add_face(const Mesh& mesh, FaceId f, int place);
    void add_line(const Mesh& mesh, VertexId v, VertexId end);
    void add_to(Label label, int side, Vec3 normal, double offset);

    double unit_;  // of costs: squared volumes to squared lengths times areas
    Vec3 origin_;
    Quadric volume_, area_;  // squared volumes and squared areas swept, relative to the origin
    bool keeps_areas_ = false;
    std::vector<Constraint> constraints_;
    std::vector<VertexId> line_ends_;
};

/// Signed: the volume of a face's first label grows by the volume swept, that of the second shrinks.
void LindstromTurk::add_to(Label label, int side, Vec3 normal, double offset) {
    if (is_exterior(label)) return;
    const auto at = std::find_if(constraints_.begin(), constraints_.end(),
                                 [&](const Constraint& c) { return c.label == label && c.side == side; });
    Constraint& constraint =
        at != constraints_.end() ? *at : constraints_.emplace_back(Constraint{label, side, {}, 0, 0});
    constraint.normal += normal;
    constraint.offset += offset;
    constraint.size += length(normal);
}

void LindstromTurk::add_face(const Mesh& mesh, FaceId f, int place) {
    const Face& face = mesh[f];
    std::array<Vec3, 3> p = mesh.corners(f);
    for (Vec3& corner : p) corner = corner - origin_;
    // Volume of the tetrahedron from the face to x: normal . x - offset.
    const Vec3 normal = area_vector(p[0], p[1], p[2]) / 6;
    const double offset = dot(normal, p[0]);
    volume_.add_plane(normal, -offset, 1);
    add_to(face.labels[0], -1, normal, offset);
    add_to(face.labels[1], -1, -normal, -offset);
    if (!keeps_areas_ || is_exterior(face.labels[1])) return;
    for (int n = 0; n < 3; ++n) {
        if (n == place_after(place)) continue;  // the edge of the link
        const int next = (n + 1) % 3;
        const SideSet sides = mesh[face.vertices[n]].sides & mesh[face.vertices[next]].sides;
        for (int side = 0; side < 6; ++side) {
            if ((sides >> side & 1) == 0) continue;
            Vec3 upright;
            upright[side / 2] = 1;
            const Vec3 across = 0.5 * cross(upright, p[next] - p[n]);
            add_to(face.labels[0], side, across, dot(across, p[n]));
            add_to(face.labels[1], side, -across, -dot(across, p[n]));
        }
    }
}

/// Squared area of the triangle from an edge to x, where the edge is one of a line.
void LindstromTurk::add_line(const Mesh& mesh, VertexId v, VertexId end) {
    if (mesh[end].label_count < 3 || std::find(line_ends_.begin(), line_ends_.end(), end) != line_ends_.end()) return;
    line_ends_.push_back(end);
    if (edge_labels(mesh, v, end).size() < 3) return;
    const Vec3 from = mesh.position(v) - origin_, d = mesh.position(end) - mesh.position(v);
    Quadric q;
    q.xx = 0.25 * (d.y * d.y + d.z * d.z), q.yy = 0.25 * (d.x * d.x + d.z * d.z), q.zz = 0.25 * (d.x * d.x + d.y * d.y);
    q.xy = -0.25 * d.x * d.y, q.xz = -0.25 * d.x * d.z, q.yz = -0.25 * d.y * d.z;
    area_ += q.seen_from(-from);
}

void LindstromTurk::add_star(const Mesh& mesh, VertexId v, VertexId except) {
    const bool is_on_line = mesh[v].label_count > 2;
    line_ends_.clear();
    if (except != kNoVertex) line_ends_.push_back(except);
    mesh.for_star(v, [&](FaceId f, int place) {
        const auto& corners = mesh[f].vertices;
        const VertexId a = corners[place_after(place)], b = corners[place_before(place)];
        if (a != except && b != except) add_face(mesh, f, place);
        if (!is_on_line) return;
        add_line(mesh, v, a);
        add_line(mesh, v, b);
    });
}

LindstromTurk::Solution LindstromTurk::solve(const Mesh& mesh, VertexId goes, VertexId stays) {
    const Vec3 middle = 0.5 * (mesh.position(goes) + mesh.position(stays));
    const SideSet sides = mesh[goes].sides | mesh[stays].sides;
    keeps_areas_ = sides != 0;
    begin(middle);
    add_star(mesh, goes, kNoVertex);
    add_star(mesh, stays, goes);
    ConstrainedPoint point;
    const auto fixed = [&](int axis) {
        return mesh.position(has_side_of(mesh[stays].sides, axis) ? stays : goes)[axis];
    };
    for (int axis = 0; axis < 3; ++axis)
        if (has_side_of(sides, axis)) point.fix(axis, fixed(axis) - middle[axis]);
    for (const bool is_volume : {true, false})
        for (const Constraint& c : constraints_)
            if ((c.side < 0) == is_volume) point.meet(c.normal, c.offset, c.size);
    Quadric q = volume_;
    const double length_2 = length2(mesh.position(goes) - mesh.position(stays));
    Quadric& lines = area_;
    for (double* entry : {&lines.xx, &lines.xy, &lines.xz, &lines.yy, &lines.yz, &lines.zz, &lines.b.x, &lines.b.y,
                          &lines.b.z, &lines.c})
        *entry *= length_2;
    q += lines;
    const Vec3 step = point.least(q, kRegularisation * q.weight());
    Solution solution{middle + step, unit_ * std::max(q.at(step), 0.0), unit_ * q.weight(), q};
    for (int axis = 0; axis < 3; ++axis)
        if (has_side_of(sides, axis)) solution.position[axis] = fixed(axis);
    return solution;
}

void LindstromTurk::rank(const Mesh& mesh, VertexId v, std::span<const VertexId> to, std::vector<EdgeCost>& costs) {
    costs.resize((to.size() + 3) / 4 * 4);
    for (std::size_t n = 0; n < to.size(); ++n) {
        const Solution best = solve(mesh, v, to[n]);
        const double draw = kLengthShare * best.weight * length2(mesh.position(v) - mesh.position(to[n]));
        costs[n] = {static_cast<float>(best.cost), static_cast<float>(best.weight),
                    static_cast<float>(best.cost + draw)};
    }
}

void LindstromTurk::rank_halves(const Mesh& mesh, VertexId v, std::span<const VertexId> to,
                                std::vector<HalfCost>& costs) {
    keeps_areas_ = false;
    begin(mesh.position(v));
    add_star(mesh, v, kNoVertex);
    costs.clear();
    for (VertexId w : to) {
        const Vec3 step = mesh.position(w) - mesh.position(v);
        const double length_2 = length2(step);
        costs.push_back({unit_ * std::max(volume_.at(step) + length_2 * area_.at(step), 0.0),
                         unit_ * (volume_.weight() + length_2 * area_.weight())});
    }
}

Places LindstromTurk::place(const Mesh& mesh, const EdgeStar& star) {
    const Solution best = solve(mesh, star.goes, star.stays);
    Places places{star.kept_level(best.position)};
    const double flat = kFlat * best.weight * length2(star.at_goes - star.at_stays);
    if (best.cost > flat) return places;
    const Vec3 average = star.kept_level(average_of_link(mesh, star));
    if (unit_ * best.quadric.at(average - origin_) <= flat) places.second = average;
    return places;
}

}  // namespace

std::unique_ptr<Placement> make_lindstrom_turk_placement(const Mesh&, const SimplifyOptions& options, std::uint32_t) {
    return std::make_unique<LindstromTurk>(options.promises.scale);
}

}  // namespace regionmesh
