#include "judge/verdict/pinch.h"

#include <algorithm>

#include "base/exact_predicates.h"
#include "base/triangle.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

/// Two faces that pass their common edge in opposite directions look the same way; their normals then are as the angle
/// between their pages, from the other side. Lengths are squared.
bool is_pinched(Vec3 n, double n_length2, Vec3 m, double m_length2, bool opposite, double max_cosine) {
    const double product = opposite ? -dot(n, m) : dot(n, m);
    return product > 0 && product * product > max_cosine * max_cosine * n_length2 * m_length2;
}

/// All new faces look at most 60 degrees away from one direction: no two of a disk are near to closing.
bool is_nearly_flat(const EdgeStar& star) {
    Lanes3<Double2> sums{};
    for (const StarPair& pair : star.pairs) {
        sums.x += pair.new_normal.x;
        sums.y += pair.new_normal.y;
        sums.z += pair.new_normal.z;
    }
    const Vec3 sum = sums[0] + sums[1];
    const Double2 bound = both(0.25 * length2(sum));
    const Lanes3<Double2> direction = both(sum);
    unsigned within = 3;
    for (const StarPair& pair : star.pairs) {
        within &= bits_of(are_above(dot(pair.new_normal, direction), bound * pair.new_length2));
    }
    return within == 3;
}

/// Pages at the edges from the merged vertex.
bool pinches_at_spokes(const EdgeStar& star, double max_cosine) {
    if (star.is_interface && is_nearly_flat(star)) return false;
    for (int i = 0; i < star.face_count(); ++i) {
        const StarFace& f = star.faces[i];
        for (int j = i + 1; j < star.face_count(); ++j) {
            const StarFace& g = star.faces[j];
            const bool opposite = (f.a == g.b) | (f.b == g.a);
            const bool same = (f.a == g.a) | (f.b == g.b);
            if (!(opposite | same)) continue;
            if (is_pinched(star.new_normal(i), star.new_length2(i), star.new_normal(j), star.new_length2(j), opposite,
                           max_cosine))
                return true;
        }
    }
    return false;
}

/// Has the page between a, b and `now` swept over x, coming from `before`? Exact; requires a turn of less than half a
/// circle.
bool sweeps_over(Vec3 a, Vec3 b, Vec3 before, Vec3 now, Vec3 x) {
    const int turn = orientation(a, b, before, now);
    return turn != 0 && orientation(a, b, before, x) == turn && orientation(a, b, x, now) == turn;
}

}  // namespace

Verdict test_pinch(const Judge& judge, Change& change) {
    return pinches_at_spokes(change.star, judge.bounds().min_dihedral_cosine) ? Verdict::kPinch : Verdict::kAccepted;
}

bool pinches_beyond(const EdgeStar& star, int n, Vec3 position, Vec3 third, bool runs_back, const ShapeBounds& bounds) {
    const Vec3 a = star.at_a(n), b = star.at_b(n), normal = star.new_normal(n);
    const Vec3 m = runs_back ? area_vector(b, a, third) : area_vector(a, b, third);
    if ((runs_back ? -dot(m, normal) : dot(m, normal)) <= 0) return false;
    return is_pinched(normal, star.new_length2(n), m, length2(m), runs_back, bounds.min_dihedral_cosine) ||
           sweeps_over(a, b, star.at_apex(n), position, third);
}

bool pinches_beside(const EdgeStar& star, int n, bool at_a, const KeptFace& kept, const ShapeBounds& bounds) {
    const Vec3 normal = star.new_normal(n), at = star.at_stays;
    const Vec3 end = at_a ? star.at_a(n) : star.at_b(n), other = at_a ? star.at_b(n) : star.at_a(n);
    const Vec3 m = kept.leads_to_stays ? area_vector(end, at, kept.third) : area_vector(at, end, kept.third);
    const bool opposite = kept.leads_to_stays == at_a;
    return is_pinched(normal, star.new_length2(n), m, length2(m), opposite, bounds.min_dihedral_cosine) ||
           (kept.is_on_line && sweeps_over(at, end, star.at_goes, other, kept.third));
}

namespace {

bool pinches_at_link(const Mesh& mesh, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds,
                     std::span<const FaceId> gone) {
    for (int n = 0; n < star.face_count(); ++n) {
        const StarFace& f = star.faces[n];
        bool pinched = false;
        mesh.for_star(f.a, [&](FaceId g, int place) {
            const auto& v = mesh[g].vertices;
            const VertexId after = v[place_after(place)], before = v[place_before(place)];
            if (pinched || (after != f.b && before != f.b) || std::ranges::find(gone, g) != gone.end()) return;
            const VertexId third = after == f.b ? before : after;
            if (third == star.goes || (third == star.stays && !star.keeps_stays)) return;
            pinched = pinches_beyond(star, n, position, mesh.position(third), before == f.b, bounds);
        });
        if (pinched) return true;
    }
    return false;
}

bool pinches_at_stays(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds) {
    bool pinched = false;
    mesh.for_star(star.stays, [&](FaceId f, int place) {
        const auto& v = mesh[f].vertices;
        const VertexId after = v[place_after(place)], before = v[place_before(place)];
        if (after == star.goes || before == star.goes) return;
        for (int n = 0; n < star.face_count(); ++n) {
            for (VertexId end : {after, before}) {
                if (end != star.faces[n].a && end != star.faces[n].b) continue;
                const KeptFace kept{end == before, mesh.position(end == before ? after : before),
                                    is_on_line(mesh, star, end)};
                pinched = pinched || pinches_beside(star, n, end == star.faces[n].a, kept, bounds);
            }
        }
    });
    return pinched;
}

}  // namespace

bool pinches_around(const Mesh& mesh, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds,
                    std::span<const FaceId> gone) {
    return pinches_at_link(mesh, star, position, bounds, gone) ||
           (star.keeps_stays && pinches_at_stays(mesh, star, bounds));
}

}  // namespace regionmesh
