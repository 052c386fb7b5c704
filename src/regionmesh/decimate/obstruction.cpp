#include "regionmesh/decimate/obstruction.h"

#include <algorithm>

#include "regionmesh/base/triangle.h"
#include "regionmesh/model/exact_predicates.h"

namespace regionmesh {
namespace {

/// out . step is positive beyond doubt: by far more than its rounding error.
bool is_ahead(Vec3 out, Vec3 step) {
    const double x = out.x * step.x, y = out.y * step.y, z = out.z * step.z;
    return x + y + z > 1e-10 * (std::abs(x) + std::abs(y) + std::abs(z));
}

bool overlap(const Box& box, const std::array<Vec3, 3>& p) {
    for (int axis = 0; axis < 3; ++axis) {
        if (p[0][axis] > box.high[axis] && p[1][axis] > box.high[axis] && p[2][axis] > box.high[axis]) return false;
        if (p[0][axis] < box.low[axis] && p[1][axis] < box.low[axis] && p[2][axis] < box.low[axis]) return false;
    }
    return true;
}

/// A plane through an edge of t, square to t, has all of p beyond it: they lie beside each other.
bool has_edge_between(const std::array<Vec3, 3>& t, const std::array<Vec3, 3>& p) {
    const Vec3 normal = area_vector(t[0], t[1], t[2]);
    for (int n = 0; n < 3; ++n) {
        const Vec3 out = cross(t[(n + 1) % 3] - t[n], normal);
        if (is_ahead(out, p[0] - t[n]) && is_ahead(out, p[1] - t[n]) && is_ahead(out, p[2] - t[n])) return true;
    }
    return false;
}

/// A plane through p and a or b, square to the triangle p a b, has x and y beyond it.
bool has_ray_between(Vec3 p, Vec3 a, Vec3 b, Vec3 x, Vec3 y) {
    const Vec3 normal = cross(a - p, b - p);
    const Vec3 beyond_a = cross(a - p, normal), beyond_b = cross(normal, b - p);
    return (is_ahead(beyond_a, x - p) && is_ahead(beyond_a, y - p)) || (is_ahead(beyond_b, x - p) && is_ahead(beyond_b, y - p));
}

/// Do triangles p a b and p x y meet outside p?
bool do_cones_meet(Vec3 p, Vec3 a, Vec3 b, Vec3 x, Vec3 y) {
    return !has_ray_between(p, a, b, x, y) && !has_ray_between(p, x, y, a, b) && meet_beyond_vertex(p, a, b, x, y);
}

bool is_in_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    const int side = orientation(a, b, c, d);
    return side != 0 && orientation(a, b, c, q) == side && orientation(a, d, b, q) == side && orientation(b, d, c, q) == side &&
           orientation(c, d, a, q) == side;
}

std::uint64_t bit_of(VertexId v) { return std::uint64_t{1} << (index(v) & 63); }

/// All faces of the star lie in one plane square to an axis, exactly, and stay there: an interface or a side of the box.
/// Since none folds, the new faces tile the very polygon that the old ones did, and nothing can be in their way.
bool is_flat(const Model& model, const EdgeStar& star, Vec3 position) {
    const auto& labels = model[star.dead.front()].labels;
    for (int axis = 0; axis < 3; ++axis) {
        const double level = position[axis];
        if (model.position(star.goes)[axis] != level || model.position(star.stays)[axis] != level) continue;
        return std::all_of(star.faces.begin(), star.faces.end(), [&](const StarFace& f) {
            return f.at_a[axis] == level && f.at_b[axis] == level && model[f.face].labels == labels;
        });
    }
    return false;
}

}  // namespace

bool Obstruction::blocks(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position) {
    if (is_flat(model, star, position)) return false;
    prepare(model, star, position);
    bool blocked = false;
    tree.search(box_, [&](FaceId f) {
        const auto& v = model[f].vertices;
        if (v[0] == star.goes || v[1] == star.goes || v[2] == star.goes) return true;
        if (v[0] == star.stays || v[1] == star.stays || v[2] == star.stays) return true;
        const Corners p = model.corners(f);
        if (!overlap(box_, p)) return true;
        const Shared shared = find_shared(v, p);
        if (is_clear(shared, p)) return true;
        blocked = meets_new_face(v, p) || (shared.count == 0 && is_swept(model, star, p[0]));
        return !blocked;
    });
    return blocked;
}

void Obstruction::prepare(const Model& model, const EdgeStar& star, Vec3 position) {
    position_ = position;
    ends_ = {model.position(star.goes), model.position(star.stays)};
    box_ = Box{};
    box_.add(position);
    normal_ = Vec3{};
    faces_.clear();
    for (const StarFace& f : star.faces) {
        normal_ += f.new_normal;
        NewFace made{f.a, f.b, {position, f.at_a, f.at_b}, {}, {}, NewFace::kUnknown};
        for (int n = 0; n < 3; ++n) {
            made.box.add(made.corners[n]);
            made.walls[n] = {made.corners[n], cross(made.corners[(n + 1) % 3] - made.corners[n], f.new_normal)};
        }
        faces_.push_back(made);
    }
    low_ = high_ = 0;
    const auto reach = [&](Vec3 p) {
        box_.add(p);
        const double along = dot(normal_, p - position);
        low_ = std::min(low_, along);
        high_ = std::max(high_, along);
    };
    for (Vec3 end : ends_) reach(end);
    link_.assign(star.link.begin(), star.link.end());
    link_at_.clear();
    link_bits_ = 0;
    for (VertexId v : link_) {
        link_at_.push_back(model.position(v));
        reach(link_at_.back());
        link_bits_ |= bit_of(v);
    }
}

Obstruction::Shared Obstruction::find_shared(const std::array<VertexId, 3>& vertices, const Corners& p) const {
    Shared shared;
    int own = 0;
    for (int n = 0; n < 3; ++n) {
        if ((link_bits_ & bit_of(vertices[n])) != 0 && std::find(link_.begin(), link_.end(), vertices[n]) != link_.end()) {
            shared.at = p[n];
            shared.vertices[shared.count++] = vertices[n];
        } else {
            shared.own[own++] = p[n];
        }
    }
    return shared;
}

/// Cheap proofs that a face cannot meet the new star outside what they share: a wall on a link edge that has the star
/// behind it and the face before it, or touching it in shared corners only; beyond everything; above or below everything.
/// Where the face shares nothing they hold for all that is swept, too.
bool Obstruction::is_clear(const Shared& shared, const Corners& p) {
    if (shared.count == 3) return false;
    for (NewFace& face : faces_) {
        const auto is_end = [&](VertexId v) { return v == face.a || v == face.b; };
        if (shared.count >= 1 && !is_end(shared.vertices[0])) continue;
        if (shared.count == 2 && !is_end(shared.vertices[1])) continue;
        const Wall& wall = face.walls[1];
        const Vec3 at = shared.count > 0 ? shared.at : wall.at;
        bool before = true;
        for (int n = 0; n < 3 - shared.count && before; ++n) before = is_ahead(wall.out, shared.own[n] - at);
        if (before && supports(face)) return true;
    }
    return shared.count == 0 && (is_off_slab(p) || is_beyond_all(p));
}

/// Is all that the star sweeps, but the ends of its link edge, behind the wall on that edge?
bool Obstruction::supports(NewFace& face) const {
    if (face.support == NewFace::kUnknown) {
        const Wall& wall = face.walls[1];
        bool all = is_ahead(wall.out, wall.at - ends_[0]) && is_ahead(wall.out, wall.at - ends_[1]);
        for (std::size_t n = 0; n < link_.size() && all; ++n)
            all = link_[n] == face.a || link_[n] == face.b || is_ahead(wall.out, wall.at - link_at_[n]);
        face.support = all ? NewFace::kSupports : NewFace::kDoesNot;
    }
    return face.support == NewFace::kSupports;
}

/// The face lies farther along the way to its middle than all that the star sweeps. The way has no part along the mean
/// normal: separate faces of one sheet lie beside each other, not above.
bool Obstruction::is_beyond_all(const Corners& p) const {
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3.0 - position_;
    const Vec3 out = middle - dot(middle, normal_) / std::max(length2(normal_), 1e-300) * normal_;
    int nearest = 0;
    for (int n = 1; n < 3; ++n)
        if (dot(out, p[n] - p[nearest]) < 0) nearest = n;
    const Vec3 at = p[nearest];
    for (int n = 0; n < 3; ++n)
        if (n != nearest && !is_ahead(out, p[n] - at)) return false;
    return is_ahead(out, at - position_) && is_ahead(out, at - ends_[0]) && is_ahead(out, at - ends_[1]) &&
           std::all_of(link_at_.begin(), link_at_.end(), [&](Vec3 q) { return is_ahead(out, at - q); });
}

/// The face lies above or below all that the star sweeps, along the mean new normal.
bool Obstruction::is_off_slab(const Corners& p) const {
    const auto size = [](Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); };
    const double slack = 1e-10 * size(normal_) * size(box_.high - box_.low);
    bool above = true, below = true;
    for (Vec3 q : p) {
        const double along = dot(normal_, q - position_);
        const double own_slack = slack + 1e-10 * size(normal_) * size(q - position_);
        above &= along > high_ + own_slack;
        below &= along < low_ - own_slack;
    }
    return above || below;
}

bool Obstruction::meets_new_face(const std::array<VertexId, 3>& vertices, const Corners& p) const {
    for (const NewFace& face : faces_) {
        if (!overlap(face.box, p)) continue;
        int at_a = -1, at_b = -1;
        for (int n = 0; n < 3; ++n) {
            if (vertices[n] == face.a) at_a = n;
            if (vertices[n] == face.b) at_b = n;
        }
        const auto& t = face.corners;
        if (at_a >= 0 && at_b >= 0) {
            if (meet_beyond_edge(t[1], t[2], t[0], p[3 - at_a - at_b])) return true;
        } else if (at_a >= 0) {
            if (do_cones_meet(t[1], t[2], t[0], p[(at_a + 1) % 3], p[(at_a + 2) % 3])) return true;
        } else if (at_b >= 0) {
            if (do_cones_meet(t[2], t[0], t[1], p[(at_b + 1) % 3], p[(at_b + 2) % 3])) return true;
        } else {
            const auto is_before = [&](const Wall& wall) {
                return is_ahead(wall.out, p[0] - wall.at) && is_ahead(wall.out, p[1] - wall.at) && is_ahead(wall.out, p[2] - wall.at);
            };
            if (is_before(face.walls[1]) || is_before(face.walls[0]) || is_before(face.walls[2]) || has_edge_between(p, t)) continue;
            if (meet({t[0], t[1], t[2]}, {p[0], p[1], p[2]})) return true;
        }
    }
    return false;
}

/// The star sweeps the cone from the merged vertex over the old faces. A part of the surface that is not joined to the
/// star and meets none of its faces, old or new, has not changed sides if it has a point outside that cone.
bool Obstruction::is_swept(const Model& model, const EdgeStar& star, Vec3 q) const {
    for (int axis = 0; axis < 3; ++axis)
        if (q[axis] < box_.low[axis] || q[axis] > box_.high[axis]) return false;
    for (const StarFace& f : star.faces)
        if (is_in_tetrahedron(position_, model.position(f.apex), f.at_a, f.at_b, q)) return true;
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return is_in_tetrahedron(position_, ends_[0], ends_[1], model.position(apex), q);
    });
}

}  // namespace regionmesh
