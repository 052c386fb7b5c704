#include "regionmesh/decimate/obstruction.h"

#include <algorithm>

#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_meeting.h"

namespace regionmesh {
namespace {

bool is_in_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    const int side = orientation(a, b, c, d);
    return side != 0 && orientation(a, b, c, q) == side && orientation(a, d, b, q) == side &&
           orientation(b, d, c, q) == side && orientation(c, d, a, q) == side;
}

/// The plane of a face, and how sure it is of sides.
class FacePlane {
public:
    explicit FacePlane(const std::array<Vec3, 3>& p) : at_(p[0]), normal_(cross(p[1] - p[0], p[2] - p[0])) {
        doubt_ = kDoubt * size(p[1] - p[0]) * size(p[2] - p[0]);
    }
    /// +1 where the normal points, -1 on the other side, 0 where rounding may tell.
    int side(Vec3 q) const {
        const Vec3 step = q - at_;
        const double ahead = dot(normal_, step), doubt = doubt_ * size(step);
        return ahead > doubt ? 1 : ahead < -doubt ? -1 : 0;
    }

private:
    static constexpr double kDoubt = 1e-12;
    static double size(Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }
    Vec3 at_, normal_;
    double doubt_;
};

/// Are these multiples of 1/64 and less than 64? Products of three of them are exact.
bool are_short(const Lanes3<Double2>& p) {
    // Adding 1.5 * 2^46 leaves no digits beyond 1/64.
    const Double2 round = both(0x1.8p46), most = both(64), zero = both(0);
    unsigned ok = 3;
    for (Double2 x : {p.x, p.y, p.z})
        ok &= bits_of(((x + round) - round == x) & (greatest(x, zero - x) < most));
    return ok == 3;
}

/// Do all corners lie in one plane, exactly? Told only where the coordinates have few digits, as those of samples do.
bool is_in_one_plane(const EdgeStar& star) {
    const Lanes3<Double2> origin = both(star.at_goes), normal = both(star.pairs[0].old_normal[0]);
    for (const StarPair& pair : star.pairs) {
        const Lanes3<Double2> a = pair.a - origin, b = pair.b - origin;
        if (!are_short(a) || !are_short(b)) return false;
        if (bits_of((dot(normal, a) == both(0)) & (dot(normal, b) == both(0))) != 3) return false;
    }
    const Lanes3<Double2> stays = both(star.at_stays - star.at_goes);
    return are_short(stays) && bits_of(dot(normal, stays) == both(0)) == 3;
}

/// All faces of the star lie in one plane, exactly, and stay there: an interface or a side of the box. Since none
/// folds, the new faces tile the very polygon that the old ones did, and nothing can be in their way.
bool is_flat(const EdgeStar& star, Vec3 position) {
    if (!star.is_interface) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const double level = position[axis];
        if (star.at_goes[axis] == level && star.at_stays[axis] == level && star.link_box.low[axis] == level &&
            star.link_box.high[axis] == level)
            return true;
    }
    return star.keeps_stays && is_in_one_plane(star);
}

}  // namespace

Verdict Obstruction::verdict(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position,
                             const ShapeBounds& bounds) {
    if (is_flat(star, position)) return Verdict::kAccepted;
    position_ = position;
    const bool is_simple = is_simple_disk(star);
    box_ = star.link_box;
    for (Vec3 p : {position, star.at_goes, star.at_stays}) box_.add(p);
    Verdict verdict = Verdict::kAccepted;
    for (int first = 0; first < star.face_count() && verdict == Verdict::kAccepted; first += StarPlanes::kMost) {
        prepare(model, star, first);
        if (!is_simple && meets_itself(model, star)) return Verdict::kIntersect;
        tree.search(box_, [&](FaceId f, const FaceTree::GridBox&) {
            verdict = look_at(model, star, bounds, f);
            return verdict == Verdict::kAccepted;
        });
    }
    return verdict;
}

/// The new star is a disk of one interface whose faces, seen along their mean normal, all look up and go round the
/// merged vertex once: no two of them meet but in what they share. The ray that is counted lies in the first face.
bool Obstruction::is_simple_disk(const EdgeStar& star) const {
    if (!star.is_interface) return false;
    Vec3 up;
    for (int n = 0; n < star.face_count(); ++n) up += star.new_normal(n);
    const Vec3 ray = 0.5 * (star.at_a(0) + star.at_b(0)) - position_;
    const Vec3 right = cross(ray, up);
    for (int n = 0; n < star.face_count(); ++n) {
        if (!is_ahead(up, star.new_normal(n))) return false;
        if (n > 0 && !is_ahead(-right, star.at_a(n) - position_) && !is_ahead(right, star.at_b(n) - position_))
            return false;
    }
    return true;
}

/// Does a new face in hand meet one that comes after it, outside the merged vertex or the edge that they share? Planes
/// through the merged vertex tell most apart.
bool Obstruction::meets_itself(const Model& model, const EdgeStar& star) {
    for (int j = first_ + 1; j < star.face_count(); ++j) {
        const StarFace& g = star.faces[j];
        const Sides sides = place_of(model, g.a, 0).sides & place_of(model, g.b, 1).sides;
        const std::uint32_t clear = sides.beyond_a | sides.beyond_b | sides.above | sides.below;
        const std::uint32_t before = j - first_ < StarPlanes::kMost ? (1u << (j - first_)) - 1 : ~0u;
        for (std::uint32_t rest = planes_.all() & before & ~clear; rest != 0; rest &= rest - 1)
            if (meet_in_star(star, first_ + __builtin_ctz(rest), j)) return true;
    }
    return false;
}

bool Obstruction::meet_in_star(const EdgeStar& star, int i, int j) const {
    const StarFace &f = star.faces[i], &g = star.faces[j];
    const Vec3 f_a = star.at_a(i), f_b = star.at_b(i), g_a = star.at_a(j), g_b = star.at_b(j);
    const Vec3 other = g.a == f.a || g.a == f.b ? g_b : g_a;
    if (f.a == g.a || f.a == g.b) return meet_beyond_edge(position_, f_a, f_b, other);
    if (f.b == g.a || f.b == g.b) return meet_beyond_edge(position_, f_b, f_a, other);
    return meet_beyond_vertex(position_, f_a, f_b, g_a, g_b);
}

/// Takes new faces from `first` on in hand. What they know of their own corners: the planes through them.
void Obstruction::prepare(const Model& model, const EdgeStar& star, int first) {
    first_ = first;
    const int count = std::min(star.face_count() - first, StarPlanes::kMost);
    planes_.prepare(star, position_, first, count);
    if (++search_ == 0) {
        std::fill(table_.begin(), table_.end(), Place());
        search_ = 1;
    }
    used_ = 0;
    Place& goes = place_of(model, star.goes, 0);
    goes.kind = Kind::kGoes;
    Place& stays = place_of(model, star.stays, 0);
    stays.kind = star.keeps_stays ? Kind::kStays : Kind::kGoes;
    apex_above_ = apex_below_ = 0;
    for (int n = 0; n < count; ++n) {
        const StarFace& face = star.faces[first + n];
        const Sides& apex = face.apex == star.goes ? goes.sides : stays.sides;
        apex_above_ |= apex.above & 1u << n;
        apex_below_ |= apex.below & 1u << n;
        place_of(model, face.a, 0).as_a |= 1u << n;
        place_of(model, face.b, 0).as_b |= 1u << n;
    }
    for (VertexId v : star.link) {
        Place& place = place_of(model, v, 0);
        const std::uint32_t own = place.as_a | place.as_b;
        if (own != 0) place.kind = Kind::kLink;
        place.sides.beyond_link |= own;
        place.sides.beyond_a |= place.as_a;
        place.sides.beyond_b |= place.as_b;
        place.sides.above |= own;
        place.sides.below |= own;
    }
    if (!star.keeps_stays) return;
    const std::uint32_t all = planes_.all();
    stays.sides.beyond_a = stays.sides.beyond_b = stays.sides.above = stays.sides.below = all;
}

Obstruction::Place& Obstruction::find_place(const Model& model, VertexId v, int corner) {
    std::uint32_t at = hash(v);
    for (; table_[at].key >> 32 == search_; at = (at + 1) % kPlaces)
        if (table_[at].key == key_of(v)) return table_[at];
    const bool has_room = used_ < kPlaces / 4 * 3;
    used_ += has_room;
    Place& place = has_room ? table_[at] : spare_[corner];
    place = {key_of(v), planes_.sides_of(model.position(v)), Kind::kOutside, 0, 0};
    return place;
}

/// Is it beyond doubt that the face does not meet any new face, comes near none, and is not swept over?
Verdict Obstruction::look_at(const Model& model, const EdgeStar& star, const ShapeBounds& bounds, FaceId f) {
    const auto& v = model[f].vertices;
    const Place &p = place_of(model, v[0], 0), &q = place_of(model, v[1], 1), &r = place_of(model, v[2], 2);
    if (p.kind == Kind::kGoes || q.kind == Kind::kGoes || r.kind == Kind::kGoes) return Verdict::kAccepted;
    const Corners old{&p, &q, &r};
    const int shared = (p.kind != Kind::kOutside) + (q.kind != Kind::kOutside) + (r.kind != Kind::kOutside);
    if (shared >= 2 && pinches(model, star, bounds, old)) return Verdict::kPinch;
    const std::uint32_t doubtful = planes_.all() & ~(p.sides & q.sides & r.sides).any();
    if (doubtful != 0 && meets(model, star, old, doubtful)) return Verdict::kIntersect;
    return shared == 0 && is_swept(model, star, old) ? Verdict::kIntersect : Verdict::kAccepted;
}

/// At an edge that is one of the link, or leads from there to `stays`. A corner beyond the plane that is square to the
/// new face is far from it.
bool Obstruction::pinches(const Model& model, const EdgeStar& star, const ShapeBounds& bounds,
                          const Corners& old) const {
    for (int n = 0; n < 3; ++n) {
        const Place &from = *old[n], &to = *old[(n + 1) % 3], &third = *old[(n + 2) % 3];
        const std::uint32_t along = from.as_a & to.as_b, back = from.as_b & to.as_a;
        for (std::uint32_t rest = (along | back) & ~third.sides.beyond_link; rest != 0; rest &= rest - 1) {
            const int face = __builtin_ctz(rest);
            const bool runs_back = (back >> face & 1) != 0;
            if (pinches_beyond(star, first_ + face, position_, model.position(third.vertex()), runs_back, bounds))
                return true;
        }
        if (from.kind != Kind::kStays && to.kind != Kind::kStays) continue;
        const Place& end = from.kind == Kind::kStays ? to : from;
        if ((end.as_a | end.as_b) == 0) continue;
        const KeptFace kept{to.kind == Kind::kStays, model.position(third.vertex()),
                            is_on_line(model, star, end.vertex())};
        for (std::uint32_t rest = end.as_a | end.as_b; rest != 0; rest &= rest - 1) {
            const int face = __builtin_ctz(rest);
            if (pinches_beside(star, first_ + face, (end.as_a >> face & 1) != 0, kept, bounds)) return true;
        }
    }
    return false;
}

/// Does the face meet one of the new faces named? The plane of the face tells most apart.
bool Obstruction::meets(const Model& model, const EdgeStar& star, const Corners& old, std::uint32_t faces) const {
    const PlacedFace own{{old[0]->vertex(), old[1]->vertex(), old[2]->vertex()},
                         {model.position(old[0]->vertex()), model.position(old[1]->vertex()),
                          model.position(old[2]->vertex())}};
    const FacePlane plane(own.at);
    const bool has_merged = old[0]->kind == Kind::kStays || old[1]->kind == Kind::kStays || old[2]->kind == Kind::kStays;
    const int merged_side = has_merged ? 0 : plane.side(position_);
    for (std::uint32_t rest = faces; rest != 0; rest &= rest - 1) {
        const std::uint32_t bit = rest & -rest;
        const int n = first_ + __builtin_ctz(rest);
        const auto& [face, a, b, apex] = star.faces[n];
        const bool has_a = ((old[0]->as_a | old[1]->as_a | old[2]->as_a) & bit) != 0;
        const bool has_b = ((old[0]->as_b | old[1]->as_b | old[2]->as_b) & bit) != 0;
        const PlacedFace made{{star.stays, a, b}, {position_, star.at_a(n), star.at_b(n)}};
        if (!boxes_overlap(own.at, made.at)) continue;
        // Beside the plane of the old face, but for corners that both have.
        const int side = merged_side != 0 ? merged_side : !has_a ? plane.side(made.at[1]) : plane.side(made.at[2]);
        const bool is_off = side != 0 && (has_merged || merged_side == side) &&
                            (has_a || plane.side(made.at[1]) == side) && (has_b || plane.side(made.at[2]) == side);
        if (!is_off && meet_outside_shared(made, own)) return true;
    }
    return false;
}

/// The star sweeps the cone from the merged vertex over the old faces. A part of the surface that is not joined to the
/// star and meets none of its faces, old or new, has not changed sides if it has a point outside that cone.
bool Obstruction::is_swept(const Model& model, const EdgeStar& star, const Corners& old) const {
    const Place* best = nullptr;
    std::uint32_t doubtful = 0;
    for (const Place* place : old) {
        const Vec3 p = model.position(place->vertex());
        if (max(p, box_.low) != p || min(p, box_.high) != p) return false;
        const std::uint32_t apart = (place->sides.above & apex_below_) | (place->sides.below & apex_above_);
        const std::uint32_t own = planes_.all() & ~apart;
        if (best && __builtin_popcount(own) >= __builtin_popcount(doubtful)) continue;
        best = place;
        doubtful = own;
    }
    const Vec3 q = model.position(best->vertex());
    for (std::uint32_t rest = doubtful; rest != 0; rest &= rest - 1) {
        const int n = first_ + __builtin_ctz(rest);
        if (is_in_tetrahedron(position_, star.at_apex(n), star.at_a(n), star.at_b(n), q)) return true;
    }
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return is_in_tetrahedron(position_, star.at_goes, star.at_stays, model.position(apex), q);
    });
}

}  // namespace regionmesh
