#include "regionmesh/decimate/obstruction.h"

#include <algorithm>
#include <array>

#include "regionmesh/model/exact_predicates.h"

namespace regionmesh {
namespace {

bool overlap(const Box& box, const std::array<Vec3, 3>& p) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::min({p[0][axis], p[1][axis], p[2][axis]}) > box.high[axis]) return false;
        if (std::max({p[0][axis], p[1][axis], p[2][axis]}) < box.low[axis]) return false;
    }
    return true;
}

double length1(Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

/// a . b, and far more than its rounding error: a dot product with a magnitude above this has a certain sign.
double rounding(Vec3 a, Vec3 b) { return 1e-10 * length1(a) * length1(b); }
bool is_ahead(Vec3 out, Vec3 step) { return dot(out, step) > rounding(out, step); }

/// A plane through an edge of t, square to t, has all of p beyond it: they lie beside each other.
bool has_edge_between(const std::array<Vec3, 3>& t, const std::array<Vec3, 3>& p) {
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    for (int n = 0; n < 3; ++n) {
        const Vec3 out = cross(t[(n + 1) % 3] - t[n], normal);
        if (is_ahead(out, p[0] - t[n]) && is_ahead(out, p[1] - t[n]) && is_ahead(out, p[2] - t[n])) return true;
    }
    return false;
}

bool is_in_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    const int side = orientation(a, b, c, d);
    return side != 0 && orientation(a, b, c, q) == side && orientation(a, d, b, q) == side && orientation(b, d, c, q) == side &&
           orientation(c, d, a, q) == side;
}

}  // namespace

bool Obstruction::blocks(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position) {
    if (is_flat_on_box(model, star)) return false;
    prepare(model, star, position);
    bool blocked = false;
    tree.search(box_, [&](FaceId f) {
        const auto& v = model[f].vertices;
        if (v[0] == star.goes || v[1] == star.goes || v[2] == star.goes) return true;
        if (v[0] == star.stays || v[1] == star.stays || v[2] == star.stays) return true;
        if (is_clear(model, f)) return true;
        blocked = meets_new_face(model, star, f) || (shared_ == 0 && is_swept(model, star, model.position(v[0])));
        return !blocked;
    });
    return blocked;
}

/// All faces of the star lie in one side of the box, exactly. Since none folds, the new faces tile the very polygon that
/// the old ones did, and nothing can be in their way.
bool Obstruction::is_flat_on_box(const Model& model, const EdgeStar& star) const {
    const Label outside = model[star.dead.front()].labels[1];
    return is_exterior(outside) &&
           std::all_of(star.faces.begin(), star.faces.end(), [&](const StarFace& f) { return model[f.face].labels[1] == outside; });
}

void Obstruction::prepare(const Model& model, const EdgeStar& star, Vec3 position) {
    position_ = position;
    ends_ = {model.position(star.goes), model.position(star.stays)};
    box_ = Box{};
    box_.add(position);
    normal_ = Vec3{};
    for (const StarFace& f : star.faces) normal_ += f.new_normal;
    low_ = high_ = 0;
    link_.clear();
    const auto reach = [&](Vec3 p) {
        box_.add(p);
        const double along = dot(normal_, p - position);
        low_ = std::min(low_, along);
        high_ = std::max(high_, along);
    };
    for (Vec3 end : ends_) reach(end);
    for (VertexId v : star.link) {
        link_.push_back({v, model.position(v), LinkPoint::kUnknown});
        reach(link_.back().at);
    }
}

/// Cheap proofs that f cannot meet the new star outside what they share: a box, a slab, or a plane that holds the star on
/// one side and f on the other. Where f shares nothing they hold for all that is swept, too. Sets shared_.
bool Obstruction::is_clear(const Model& model, FaceId f) {
    const auto p = model.corners(f);
    shared_ = 0;
    if (!overlap(box_, p)) return true;
    std::array<LinkPoint*, 3> shared{};
    std::array<Vec3, 3> own;
    int own_count = 0;
    for (int n = 0; n < 3; ++n) {
        const auto at = std::find_if(link_.begin(), link_.end(), [&](const LinkPoint& l) { return l.vertex == model[f].vertices[n]; });
        if (at != link_.end()) shared[shared_++] = &*at;
        else own[own_count++] = p[n];
    }
    if (shared_ == 1) {
        LinkPoint& a = *shared[0];
        const Vec3 out = a.at - position_;
        if (is_ahead(out, own[0] - a.at) && is_ahead(out, own[1] - a.at) && supports_at(a)) return true;
        const Vec3 toward = along_star(own[0] + own[1] - a.at - a.at);
        return is_ahead(toward, own[0] - a.at) && is_ahead(toward, own[1] - a.at) && is_ahead(toward, out) && is_behind(toward, a);
    }
    if (shared_ == 2) return supports_along(*shared[0], *shared[1], own[0]);
    if (shared_ == 3) return false;
    return is_beyond(along_star((p[0] + p[1] + p[2]) / 3.0 - position_), p) || is_off_slab(p);
}

/// Without its part along the mean normal: separate faces of one sheet lie beside each other, not above.
Vec3 Obstruction::along_star(Vec3 step) const { return step - dot(step, normal_) / std::max(length2(normal_), 1e-300) * normal_; }

/// All of the new star but the link point itself is behind the plane through it, square to `out`.
bool Obstruction::is_behind(Vec3 out, const LinkPoint& point) const {
    return std::all_of(link_.begin(), link_.end(), [&](const LinkPoint& l) { return l.vertex == point.vertex || is_ahead(out, point.at - l.at); });
}

/// All of p lies farther along `out` than all that the star sweeps.
bool Obstruction::is_beyond(Vec3 out, const std::array<Vec3, 3>& p) const {
    const double near = std::min({dot(out, p[0] - position_), dot(out, p[1] - position_), dot(out, p[2] - position_)});
    if (!(near > 0)) return false;
    const double slack = rounding(out, p[0] - position_) + rounding(out, p[1] - position_) + rounding(out, p[2] - position_);
    const auto is_nearer = [&](Vec3 q) { return dot(out, q - position_) + slack + rounding(out, q - position_) < near; };
    return std::all_of(link_.begin(), link_.end(), [&](const LinkPoint& l) { return is_nearer(l.at); }) && is_nearer(ends_[0]) && is_nearer(ends_[1]);
}

/// All of p lies above or below all that the star sweeps, along its mean new normal.
bool Obstruction::is_off_slab(const std::array<Vec3, 3>& p) const {
    bool above = true, below = true;
    for (Vec3 q : p) {
        const double along = dot(normal_, q - position_);
        const double slack = rounding(normal_, q - position_) + rounding(normal_, box_.high - box_.low);
        above &= along > high_ + slack;
        below &= along < low_ - slack;
    }
    return above || below;
}

/// The plane through a link point, square to its spoke, has all the rest of the new star behind it.
bool Obstruction::supports_at(LinkPoint& point) {
    if (point.support == LinkPoint::kUnknown)
        point.support = is_behind(point.at - position_, point) ? LinkPoint::kSupports : LinkPoint::kDoesNot;
    return point.support == LinkPoint::kSupports;
}

/// The same for a plane through two link points, with x before it.
bool Obstruction::supports_along(const LinkPoint& a, const LinkPoint& b, Vec3 x) const {
    const Vec3 along = b.at - a.at;
    const Vec3 spoke = a.at - position_;
    const Vec3 out = length2(along) * spoke - dot(spoke, along) * along;
    return is_ahead(out, x - a.at) && std::all_of(link_.begin(), link_.end(), [&](const LinkPoint& l) {
               return l.vertex == a.vertex || l.vertex == b.vertex || is_ahead(out, a.at - l.at);
           });
}

bool Obstruction::meets_new_face(const Model& model, const EdgeStar& star, FaceId f) const {
    const auto& v = model[f].vertices;
    const auto p = model.corners(f);
    for (const StarFace& made : star.faces) {
        int at_a = -1, at_b = -1;
        for (int n = 0; n < 3; ++n) {
            if (v[n] == made.a) at_a = n;
            if (v[n] == made.b) at_b = n;
        }
        if (at_a >= 0 && at_b >= 0) {
            if (meet_beyond_edge(made.at_a, made.at_b, position_, p[3 - at_a - at_b])) return true;
        } else if (at_a >= 0) {
            if (meet_beyond_vertex(made.at_a, made.at_b, position_, p[(at_a + 1) % 3], p[(at_a + 2) % 3])) return true;
        } else if (at_b >= 0) {
            if (meet_beyond_vertex(made.at_b, position_, made.at_a, p[(at_b + 1) % 3], p[(at_b + 2) % 3])) return true;
        } else {
            Box box;
            box.add(position_);
            box.add(made.at_a);
            box.add(made.at_b);
            const std::array<Vec3, 3> t{position_, made.at_a, made.at_b};
            if (overlap(box, p) && !has_edge_between(t, p) && !has_edge_between(p, t) && meet({t[0], t[1], t[2]}, {p[0], p[1], p[2]})) return true;
        }
    }
    return false;
}

/// The star sweeps the cone from the merged vertex over the old faces. A part of the surface that is not joined to the
/// star and meets none of its faces, old or new, has not changed sides if it has a point outside that cone.
bool Obstruction::is_swept(const Model& model, const EdgeStar& star, Vec3 q) const {
    for (const StarFace& f : star.faces)
        if (is_in_tetrahedron(position_, model.position(f.apex), f.at_a, f.at_b, q)) return true;
    const Vec3 goes = model.position(star.goes), stays = model.position(star.stays);
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return is_in_tetrahedron(position_, goes, stays, model.position(apex), q);
    });
}

}  // namespace regionmesh
