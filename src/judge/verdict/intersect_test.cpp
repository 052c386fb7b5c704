#include "judge/verdict/intersect_test.h"

#include <algorithm>
#include <optional>

#include "base/box.h"
#include "base/exact_predicates.h"
#include "mesh/face_meeting.h"

namespace regionmesh {
namespace {

/// Inside or on a wall: it may have another tetrahedron behind it.
bool is_in_tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 q) {
    const int side = orientation(a, b, c, d);
    return side != 0 && orientation(a, b, c, q) != -side && orientation(a, d, b, q) != -side &&
           orientation(b, d, c, q) != -side && orientation(c, d, a, q) != -side;
}

/// The plane of a face and those through its edges, square to it. Conservative: certain outside the rounding error.
class FacePlanes {
public:
    explicit FacePlanes(const PlacedFace& face) : face_(face) {
        const Vec3 u = face.at[1] - face.at[0], v = face.at[2] - face.at[0];
        planes_[3] = {face.at[0], cross(u, v), size_of(u) * size_of(v)};
        for (int n = 0; n < 3; ++n) {
            const Vec3 edge = face.at[(n + 1) % 3] - face.at[n];
            planes_[n] = {face.at[n], cross(edge, planes_[3].out), size_of(edge) * planes_[3].size};
        }
        is_sure_ = length2(planes_[3].out) > 1e-12 * length2(u) * length2(v);
    }
    /// Does the other face lie for certain beyond one plane, except for shared corners on the plane?
    bool are_beside(const PlacedFace& other) const {
        if (!is_sure_) return false;
        std::array<int, 3> place;  // of each corner in this face
        for (int n = 0; n < 3; ++n) {
            place[n] = -1;
            for (int m = 0; m < 3; ++m)
                if (other.vertices[n] == face_.vertices[m]) place[n] = m;
        }
        for (int n = 0; n < 3; ++n)
            if (is_beyond(planes_[n], 1, other, place, n)) return true;
        return is_beyond(planes_[3], 1, other, place, -1) || is_beyond(planes_[3], -1, other, place, -1);
    }

private:
    static constexpr double kDoubt = 1e-12;
    struct Plane {
        Vec3 at, out;
        double size;  // bounds `out` as it was computed, and its rounding
    };

    /// `edge` is the first place of the edge that the plane goes through; -1 for all places.
    static bool is_beyond(const Plane& plane, int side, const PlacedFace& other, const std::array<int, 3>& place,
                          int edge) {
        for (int n = 0; n < 3; ++n) {
            if (place[n] >= 0 && (edge < 0 || place[n] == edge || place[n] == (edge + 1) % 3)) continue;
            const Vec3 step = other.at[n] - plane.at;
            if (!(side * dot(plane.out, step) > kDoubt * plane.size * size_of(step))) return false;
        }
        return true;
    }

    const PlacedFace& face_;
    std::array<Plane, 4> planes_;
    bool is_sure_;
};

}  // namespace

Verdict IntersectTest::verdict(const Mesh& mesh, const FaceTree& tree, const RisingFaces* rising, const EdgeStar& star,
                               Vec3 position, const ShapeBounds& bounds, std::span<const FaceId> gone) {
    if (star.is_flat) return Verdict::kAccepted;
    position_ = position;
    box_ = star.link_box;
    for (Vec3 p : {position, star.at_goes, star.at_stays}) box_.add(p);
    // A star on a side of the box may end at an open rim, which moves with its vertices.
    const bool is_inside = mesh[star.goes].sides == 0 && (star.keeps_stays || mesh[star.stays].sides == 0);
    const Directions directions =
        rising && star.is_interface && is_inside ? rising->common(star, position) : Directions{0};
    is_skipping_ = directions != 0;
    const bool is_simple = directions != 0 || is_simple_disk(star);
    Verdict verdict = Verdict::kAccepted;
    for (int first = 0; first < star.face_count() && verdict == Verdict::kAccepted; first += StarPlanes::kMost) {
        bool is_prepared = !is_simple;
        if (is_prepared) prepare(mesh, star, first);
        if (!is_simple && meets_itself(star)) return Verdict::kIntersect;
        Directions common = directions;
        tree.search(box_, [&](std::span<const std::uint32_t> faces) {
            if (!gone.empty()) faces = without(gone, faces);
            if (directions != 0) faces = without_rising(mesh, *rising, star, faces, common);
            if (faces.empty()) return true;
            if (!is_prepared) prepare(mesh, star, first);
            is_prepared = true;
            find_near(mesh, star, faces);
            for (std::size_t n = 0; n < near_count_ && verdict == Verdict::kAccepted; ++n)
                verdict = look_at(mesh, star, bounds, corners_of(near_[n]));
            return verdict == Verdict::kAccepted;
        });
    }
    // A refusal is reported as all faces give it: the verdict is the same as without `rising`.
    if (verdict == Verdict::kAccepted || directions == 0) return verdict;
    return this->verdict(mesh, tree, nullptr, star, position, bounds, gone);
}

std::span<const std::uint32_t> IntersectTest::without(std::span<const FaceId> gone,
                                                      std::span<const std::uint32_t> faces) {
    left_.clear();
    for (const std::uint32_t f : faces)
        if (std::ranges::find(gone, FaceId{f}) == gone.end()) left_.push_back(f);
    return left_;
}

/// Leaves out each face of the star's interface that rises along one of the `common` directions, and keeps only such
/// directions in `common`. Without branches that depend on one face.
std::span<const std::uint32_t> IntersectTest::without_rising(const Mesh& mesh, const RisingFaces& rising,
                                                             const EdgeStar& star, std::span<const std::uint32_t> faces,
                                                             Directions& common) {
    const std::array<Label, 2> labels = mesh[star.faces[0].face].labels;
    others_.resize(faces.size() + 1);
    Directions directions = common;
    std::size_t count = 0;
    for (const std::uint32_t f : faces) {
        const std::array<Label, 2>& own = mesh[FaceId{f}].labels;
        const bool is_same = ((own[0] ^ labels[0]) | (own[1] ^ labels[1])) == 0;
        const Directions both = directions & rising[FaceId{f}] & -Directions{is_same};
        directions = both != 0 ? both : directions;
        others_[count] = f;
        count += both == 0;
    }
    common = directions;
    return std::span(others_).first(count);
}

/// The new star is a disk of one interface whose faces, seen along their mean normal, all look up and go round the
/// merged vertex once: no two of them meet but in what they share. The ray that is counted lies in the first face.
bool IntersectTest::is_simple_disk(const EdgeStar& star) const {
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

/// Does one of the current new faces meet one that comes after it, outside the merged vertex or the edge that they
/// share? Planes through the merged vertex separate most pairs.
bool IntersectTest::meets_itself(const EdgeStar& star) {
    for (int j = first_ + 1; j < star.face_count(); ++j) {
        const StarFace& g = star.faces[j];
        const Sides sides = place_of(g.a).sides & place_of(g.b).sides;
        const std::uint32_t clear = sides.a | sides.b | sides.above | sides.below;
        const std::uint32_t before = j - first_ < StarPlanes::kMost ? (1u << (j - first_)) - 1 : ~0u;
        for (std::uint32_t rest = planes_.all() & before & ~clear; rest != 0; rest &= rest - 1)
            if (meet_in_star(star, first_ + __builtin_ctz(rest), j)) return true;
    }
    return false;
}

bool IntersectTest::meet_in_star(const EdgeStar& star, int i, int j) const {
    const StarFace &f = star.faces[i], &g = star.faces[j];
    const Vec3 f_a = star.at_a(i), f_b = star.at_b(i), g_a = star.at_a(j), g_b = star.at_b(j);
    const Vec3 other = g.a == f.a || g.a == f.b ? g_b : g_a;
    if (f.a == g.a || f.a == g.b) return meet_beyond_edge(position_, f_a, f_b, other);
    if (f.b == g.a || f.b == g.b) return meet_beyond_edge(position_, f_b, f_a, other);
    return meet_beyond_vertex(position_, f_a, f_b, g_a, g_b);
}

/// Begins with new faces from `first` on. Sides of their own corners follow from the planes that pass through them.
void IntersectTest::prepare(const Mesh& mesh, const EdgeStar& star, int first) {
    first_ = first;
    const int count = std::min(star.face_count() - first, StarPlanes::kMost);
    planes_.prepare(star, position_, first, count);
    vertices_ = {star.goes, star.stays};
    vertices_.insert(vertices_.end(), star.link.begin(), star.link.end());
    numbers_.clear();
    places_.clear();
    number_vertices();
    find_sides(mesh);
    Place &goes = place_of(star.goes), &stays = place_of(star.stays);
    goes.is_of_star = 1;
    stays.is_of_star = !star.keeps_stays;
    std::uint32_t at_goes = 0;
    for (int n = 0; n < count; ++n) {
        const StarFace& face = star.faces[first + n];
        at_goes |= (face.apex == star.goes ? 1u : 0u) << n;
        place_of(face.a).as_a |= 1u << n;
        place_of(face.b).as_b |= 1u << n;
    }
    apex_ = planes_.far_sides_of(star.at_goes).of(at_goes) | planes_.far_sides_of(star.at_stays).of(~at_goes);
    for (VertexId v : star.link) {
        Place& place = place_of(v);
        const std::uint32_t own = place.as_a | place.as_b;
        place.is_shared = own != 0;
        place.sides.link |= own;
        place.sides.a |= place.as_a;
        place.sides.b |= place.as_b;
        place.sides.above |= own;
        place.sides.below |= own;
    }
    if (!star.keeps_stays) return;
    stays.is_shared = 1;
    stays.sides.a = stays.sides.b = stays.sides.above = stays.sides.below = planes_.all();
}

void IntersectTest::number_vertices() {
    corners_.resize(vertices_.size());
    numbers_.add(vertices_, corners_.data());
}

/// Fills in the places of vertices with new numbers.
void IntersectTest::find_sides(const Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(places_.size());
    for (std::uint32_t n = first; n < numbers_.size(); ++n) __builtin_prefetch(&mesh[numbers_[n]]);
    for (std::uint32_t n = first; n < numbers_.size(); ++n) {
        const Vec3 p = mesh.position(numbers_[n]);
        places_.push_back({numbers_[n], planes_.sides_of(p), 0, 0, 0, 0, is_within(p, box_)});
    }
}

/// Sets `near_`: which of the faces have to be looked at. All of them first, step by step and without branches that
/// depend on one face.
void IntersectTest::find_near(const Mesh& mesh, const EdgeStar& star, std::span<const std::uint32_t> faces) {
    vertices_.resize(3 * faces.size());
    near_.resize(faces.size() + 1);
    for (std::size_t n = 0; n < faces.size(); ++n)
        for (int c = 0; c < 3; ++c) vertices_[3 * n + c] = mesh[FaceId{faces[n]}].vertices[c];
    number_vertices();
    find_sides(mesh);
    near_count_ = 0;
    for (std::uint32_t n = 0; n < faces.size(); ++n) {
        near_[near_count_] = n;
        near_count_ += may_meet(star, corners_of(n));
    }
}

/// Could the face come too close to a new face, meet one, or lie in the space swept? In bits: comparisons would become
/// branches.
bool IntersectTest::may_meet(const EdgeStar& star, const Corners& old) const {
    const Place &p = *old[0], &q = *old[1], &r = *old[2];
    const std::uint32_t of_star = p.is_of_star | q.is_of_star | r.is_of_star;
    const std::uint32_t shared = p.is_shared + q.is_shared + r.is_shared;
    const std::uint32_t beside =
        (faces_at(p, q) & ~r.sides.link) | (faces_at(q, r) & ~p.sides.link) | (faces_at(r, p) & ~q.sides.link);
    const std::uint32_t at_stays =
        star.keeps_stays & ((p.vertex == star.stays) | (q.vertex == star.stays) | (r.vertex == star.stays));
    const std::uint32_t doubtful = planes_.all() & ~(p.sides & q.sides & r.sides).any();
    const std::uint32_t pinch = (beside | at_stays) & -(shared >> 1), swept = may_be_swept(old, shared);
    return ((doubtful | pinch | swept) & (of_star - 1)) != 0;
}

/// Does the face meet a new face, come too close to one, or lie in the space swept?
Verdict IntersectTest::look_at(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds,
                               const Corners& old) const {
    const Place &p = *old[0], &q = *old[1], &r = *old[2];
    const std::uint32_t shared = p.is_shared + q.is_shared + r.is_shared;
    if (shared >= 2 && pinches(mesh, star, bounds, old)) return Verdict::kPinch;
    const std::uint32_t doubtful = planes_.all() & ~(p.sides & q.sides & r.sides).any();
    if (doubtful != 0 && meets(mesh, star, old, doubtful)) return Verdict::kIntersect;
    return may_be_swept(old, shared) != 0 && is_swept(mesh, star, old) ? Verdict::kIntersect : Verdict::kAccepted;
}

/// At an edge that is one of the link, or leads from there to `stays`. A corner beyond the plane that is square to the
/// new face is far from it.
bool IntersectTest::pinches(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds,
                            const Corners& old) const {
    for (int n = 0; n < 3; ++n) {
        const Place &from = *old[n], &to = *old[(n + 1) % 3], &third = *old[(n + 2) % 3];
        for (std::uint32_t rest = faces_at(from, to) & ~third.sides.link; rest != 0; rest &= rest - 1) {
            const int face = __builtin_ctz(rest);
            const bool runs_back = (from.as_b >> face & 1) != 0;
            if (pinches_beyond(star, first_ + face, position_, mesh.position(third.vertex), runs_back, bounds))
                return true;
        }
        if (!star.keeps_stays || (from.vertex != star.stays && to.vertex != star.stays)) continue;
        const Place& end = from.vertex == star.stays ? to : from;
        const KeptFace kept{to.vertex == star.stays, mesh.position(third.vertex), is_on_line(mesh, star, end.vertex)};
        for (std::uint32_t rest = end.as_a | end.as_b; rest != 0; rest &= rest - 1) {
            const int face = __builtin_ctz(rest);
            if (pinches_beside(star, first_ + face, (end.as_a >> face & 1) != 0, kept, bounds)) return true;
        }
    }
    return false;
}

/// Does the face meet one of these new faces? Its own planes separate most pairs.
bool IntersectTest::meets(const Mesh& mesh, const EdgeStar& star, const Corners& old, std::uint32_t faces) const {
    const PlacedFace own{{old[0]->vertex, old[1]->vertex, old[2]->vertex},
                         {mesh.position(old[0]->vertex), mesh.position(old[1]->vertex), mesh.position(old[2]->vertex)}};
    std::optional<FacePlanes> planes;
    for (std::uint32_t rest = faces; rest != 0; rest &= rest - 1) {
        const int n = first_ + __builtin_ctz(rest);
        const PlacedFace made{{star.stays, star.faces[n].a, star.faces[n].b}, {position_, star.at_a(n), star.at_b(n)}};
        if (!boxes_overlap(own.at, made.at)) continue;
        if (!planes) {
            if (is_degenerate({own.at[0], own.at[1], own.at[2]})) return false;  // it meets none, as in the check
            planes.emplace(own);
        }
        if (!planes->are_beside(made) && meet_outside_shared(made, own)) return true;
    }
    return false;
}

/// The star sweeps the cone from the merged vertex over the old faces. A part of the surface that is not joined to the
/// star and meets none of its faces, old or new, has not changed sides if it has a point outside that cone. So has the
/// rest of a face that is joined to it. Where all corners are, it may be swept.
bool IntersectTest::is_swept(const Mesh& mesh, const EdgeStar& star, const Corners& old) const {
    const Place* best = nullptr;
    std::uint32_t doubtful = 0;
    for (const Place* place : old) {
        if (place->is_shared != 0) continue;
        const std::uint32_t own = planes_.all() & ~(place->sides & apex_).any();
        if (best && __builtin_popcount(own) >= __builtin_popcount(doubtful)) continue;
        best = place;
        doubtful = own;
    }
    if (!best) return true;
    const Vec3 q = mesh.position(best->vertex);
    for (std::uint32_t rest = doubtful; rest != 0; rest &= rest - 1) {
        const int n = first_ + __builtin_ctz(rest);
        if (is_in_tetrahedron(position_, star.at_apex(n), star.at_a(n), star.at_b(n), q)) return true;
    }
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return is_in_tetrahedron(position_, star.at_goes, star.at_stays, mesh.position(apex), q);
    });
}

}  // namespace regionmesh
