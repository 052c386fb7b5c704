#include "regionmesh/decimate/obstruction.h"

#include <algorithm>

#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_meeting.h"

namespace regionmesh {
namespace {

bool is_in_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    Box box;
    for (Vec3 p : {a, b, c, d}) box.add(p);
    if (max(q, box.low) != q || min(q, box.high) != q) return false;
    const int side = orientation(a, b, c, d);
    return side != 0 && orientation(a, b, c, q) == side && orientation(a, d, b, q) == side &&
           orientation(b, d, c, q) == side && orientation(c, d, a, q) == side;
}

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
    if (++stamp_ == 0) {
        std::fill(table_.begin(), table_.end(), Place());
        stamp_ = 1;
    }
    used_ = 0;
    apex_above_ = apex_below_ = 0;
    const Sides goes = planes_.sides_of(star.at_goes), stays = planes_.sides_of(star.at_stays);
    for (int n = 0; n < count; ++n) {
        const Sides& apex = star.faces[first + n].apex == star.goes ? goes : stays;
        apex_above_ |= apex.above & 1u << n;
        apex_below_ |= apex.below & 1u << n;
        const StarFace& face = star.faces[first + n];
        place_of(model, face.a, 0).as_a |= 1u << n;
        place_of(model, face.b, 0).as_b |= 1u << n;
    }
    for (VertexId v : star.link) {
        Place& place = place_of(model, v, 0);
        const std::uint32_t own = place.as_a | place.as_b;
        place.sides.beyond_link |= own;
        place.sides.beyond_a |= place.as_a;
        place.sides.beyond_b |= place.as_b;
        place.sides.above |= own;
        place.sides.below |= own;
    }
    if (!star.keeps_stays) return;
    Sides& stays_sides = place_of(model, star.stays, 0).sides;
    stays_sides.beyond_a = stays_sides.beyond_b = stays_sides.above = stays_sides.below = planes_.all();
}

Obstruction::Place& Obstruction::place_of(const Model& model, VertexId v, int corner) {
    std::uint32_t at = index(v) * 0x9E3779B1u >> 24;
    for (; table_[at].stamp == stamp_; at = (at + 1) % kPlaces)
        if (table_[at].vertex == v) return table_[at];
    Place& place = used_ < kPlaces / 4 * 3 ? table_[at] : spare_[corner];
    if (&place == &table_[at]) ++used_;
    place = {v, stamp_, planes_.sides_of(model.position(v)), 0, 0};
    return place;
}

/// Is it beyond doubt that the face does not meet any new face, comes near none, and is not swept over?
Verdict Obstruction::look_at(const Model& model, const EdgeStar& star, const ShapeBounds& bounds, FaceId f) {
    OldFace old{model[f].vertices, {}};
    for (VertexId v : old.vertices)
        if (v == star.goes || (v == star.stays && !star.keeps_stays)) return Verdict::kAccepted;
    for (int n = 0; n < 3; ++n) old.places[n] = &place_of(model, old.vertices[n], n);
    int shared = 0;
    for (const Place* place : old.places) shared += (place->as_a | place->as_b) != 0 || place->vertex == star.stays;
    if (shared >= 2 && pinches(model, star, bounds, old)) return Verdict::kPinch;
    const std::uint32_t clear = (old.places[0]->sides & old.places[1]->sides & old.places[2]->sides).any();
    for (std::uint32_t rest = planes_.all() & ~clear; rest != 0; rest &= rest - 1)
        if (meets(model, star, first_ + __builtin_ctz(rest), old)) return Verdict::kIntersect;
    return shared == 0 && is_swept(model, star, old) ? Verdict::kIntersect : Verdict::kAccepted;
}

/// At an edge that is one of the link. A corner beyond the plane that is square to the new face is far from it.
bool Obstruction::pinches(const Model& model, const EdgeStar& star, const ShapeBounds& bounds, const OldFace& old) const {
    for (int n = 0; n < 3; ++n) {
        const Place &from = *old.places[n], &to = *old.places[(n + 1) % 3], &third = *old.places[(n + 2) % 3];
        const std::uint32_t along = from.as_a & to.as_b, back = from.as_b & to.as_a;
        for (std::uint32_t rest = (along | back) & ~third.sides.beyond_link; rest != 0; rest &= rest - 1) {
            const int face = __builtin_ctz(rest);
            if (pinches_beyond(star, first_ + face, position_, model.position(third.vertex), (back >> face & 1) != 0, bounds))
                return true;
        }
        if (!star.keeps_stays || (from.vertex != star.stays && to.vertex != star.stays)) continue;
        const Place& end = from.vertex == star.stays ? to : from;
        const KeptFace kept{to.vertex == star.stays, model.position(third.vertex), is_on_line(model, star, end.vertex)};
        for (std::uint32_t rest = end.as_a | end.as_b; rest != 0; rest &= rest - 1) {
            const int face = __builtin_ctz(rest);
            if (pinches_beside(star, first_ + face, (end.as_a >> face & 1) != 0, kept, bounds)) return true;
        }
    }
    return false;
}

/// New face n, and a face that has none of the ends of the edge.
bool Obstruction::meets(const Model& model, const EdgeStar& star, int n, const OldFace& old) const {
    const StarFace& f = star.faces[n];
    return meet_outside_shared({{star.stays, f.a, f.b}, {position_, star.at_a(n), star.at_b(n)}},
                               {old.vertices, {model.position(old.vertices[0]), model.position(old.vertices[1]), model.position(old.vertices[2])}});
}

/// The star sweeps the cone from the merged vertex over the old faces. A part of the surface that is not joined to the
/// star and meets none of its faces, old or new, has not changed sides if it has a point outside that cone.
bool Obstruction::is_swept(const Model& model, const EdgeStar& star, const OldFace& old) const {
    for (VertexId v : old.vertices) {
        const Vec3 p = model.position(v);
        if (max(p, box_.low) != p || min(p, box_.high) != p) return false;
    }
    const Vec3 q = model.position(old.vertices[0]);
    const Sides& sides = old.places[0]->sides;
    const std::uint32_t apart = (sides.above & apex_below_) | (sides.below & apex_above_);
    for (std::uint32_t rest = planes_.all() & ~apart; rest != 0; rest &= rest - 1) {
        const int n = first_ + __builtin_ctz(rest);
        if (is_in_tetrahedron(position_, star.at_apex(n), star.at_a(n), star.at_b(n), q)) return true;
    }
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return is_in_tetrahedron(position_, star.at_goes, star.at_stays, model.position(apex), q);
    });
}

}  // namespace regionmesh
