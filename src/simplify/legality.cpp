#include "simplify/legality.h"

#include <algorithm>

#include "base/exact_predicates.h"
#include "base/triangle.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

bool contains(const std::vector<VertexId>& set, VertexId v) {
    return std::find(set.begin(), set.end(), v) != set.end();
}

std::uint64_t bit_of(VertexId v) { return std::uint64_t{1} << (index(v) & 63); }

/// Every common neighbour of the ends must be an apex of the edge, and they may have no link edge in common.
bool is_link_condition_met(const EdgeStar& star) {
    // Only apexes are common to most: a bit for each neighbour of the end that goes, by id modulo 64.
    std::uint64_t near_goes = 0;
    for (const StarFace& f : star.faces)
        if (f.apex == star.goes) near_goes |= bit_of(f.a) | bit_of(f.b);
    for (const StarFace& g : star.faces) {
        if (g.apex != star.stays || ((bit_of(g.a) | bit_of(g.b)) & near_goes) == 0) continue;
        for (const StarFace& f : star.faces) {
            if (f.apex != star.goes) continue;
            const bool shares_a = f.a == g.a || f.a == g.b, shares_b = f.b == g.a || f.b == g.b;
            if (shares_a && shares_b) return false;
            if ((shares_a && !contains(star.apexes, f.a)) || (shares_b && !contains(star.apexes, f.b))) return false;
        }
    }
    return true;
}

/// Two lines that leave the ends of a line edge must not meet in the next vertex.
bool closes_loop_of_lines(const Mesh& mesh, const EdgeStar& star) {
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return edge_labels(mesh, star.goes, apex).size() > 2 && edge_labels(mesh, star.stays, apex).size() > 2;
    });
}

/// Would an edge come to lie on an edge of the box that lay beside it before? Where the box has faces this is a loop of
/// lines; where it has none (not capped, or background) the rim of a sheet would close on itself unseen.
bool lands_on_box_edge(const Mesh& mesh, const EdgeStar& star) {
    const SideSet stays = mesh[star.stays].sides, both = stays & mesh[star.goes].sides;
    const auto is_on_edge = [](unsigned sides) { return (sides & (sides - 1)) != 0; };
    if (!is_on_edge(stays)) return false;
    return std::any_of(star.link.begin(), star.link.end(), [&](VertexId v) {
        const SideSet sides = mesh[v].sides;
        if (!is_on_edge(stays & sides) || is_on_edge(both & sides) || contains(star.apexes, v)) return false;
        return std::any_of(star.faces.begin(), star.faces.end(),
                           [&](const StarFace& f) { return f.apex == star.goes && (f.a == v || f.b == v); });
    });
}

/// Two faces that pass their common edge in opposite directions look the same way; their normals then are as the angle
/// between their pages, from the other side. Lengths are squared.
bool is_pinched(Vec3 n, double n_length2, Vec3 m, double m_length2, bool opposite, double max_cosine) {
    const double product = opposite ? -dot(n, m) : dot(n, m);
    return product > 0 && product * product > max_cosine * max_cosine * n_length2 * m_length2;
}

/// Are these products of vectors above the bounds, which are given squared?
Mask2 are_above(Double2 products, Double2 bounds2) { return (products > both(0)) & (products * products > bounds2); }

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

bool folds(const EdgeStar& star, const ShapeBounds& bounds) {
    const Double2 bound = both(bounds.min_turn_cosine * bounds.min_turn_cosine);
    unsigned within = 3;
    for (const StarPair& pair : star.pairs) {
        within &=
            bits_of(are_above(dot(pair.old_normal, pair.new_normal), bound * pair.old_length2 * pair.new_length2));
    }
    return within != 3;
}

double cube_of_bound(const ShapeBounds& bounds) {
    // A little more than asked, so that rounding does not take a face below when it is measured from another corner.
    return bounds.min_quality * bounds.min_quality * bounds.min_quality * (1 + 1e-12);
}

/// Third power of the quality of each of two faces from a vertex to the link, given twice the areas squared
/// (QualityTerms::cube, side by side).
Double2 quality3(const StarPair& pair, const Lanes3<Double2>& to_a, const Lanes3<Double2>& to_b, Double2 length2) {
    const Double2 a = square_root(dot(to_a, to_a)), b = square_root(dot(to_b, to_b)),
                  c = square_root(pair.link_length2), area = both(0.5) * square_root(length2);
    const Double2 shortest = least(a, least(b, c));
    const Double2 others = greatest(a, greatest(b, c)) * greatest(least(a, b), least(greatest(a, b), c));
    const Double2 product = others * (shortest + both(8) * area / (a + b + c));
    return area * area * area / (product * product);
}

/// The least quality of the faces of a star, to the third power, and how many are below the bound.
struct LowQuality {
    double worst3;
    int below;
};

/// Where faces came in below the bound, a collapse may leave some: no more, and none worse than the worst.
bool was_worse(const EdgeStar& star, const LowQuality& after, double bound3) {
    LowQuality before{1, 0};
    const auto look_at = [&](Vec3 a, Vec3 b, Vec3 c) {
        const double own3 = quality_terms(a, b, c).cube();
        before.worst3 = std::min(before.worst3, own3);
        before.below += own3 < bound3;
    };
    for (int face = 0; face < star.face_count(); ++face) look_at(star.at_apex(face), star.at_a(face), star.at_b(face));
    return after.below <= before.below && after.worst3 >= before.worst3;
}

}  // namespace

Verdict topology_verdict(const Mesh& mesh, const EdgeStar& star) {
    // All edges of a vertex of two labels have both.
    const bool is_inside_interface = mesh[star.goes].label_count == 2;
    const int edge_count = is_inside_interface ? 2 : edge_labels(mesh, star.goes, star.stays).size();
    if (!is_inside_interface && edge_count != vertex_labels(mesh, star.goes).size()) return Verdict::kStrata;
    if (star.faces.empty() || !is_link_condition_met(star)) return Verdict::kLink;
    if (edge_count > 2 && closes_loop_of_lines(mesh, star)) return Verdict::kLink;
    if (lands_on_box_edge(mesh, star)) return Verdict::kLink;
    return Verdict::kAccepted;
}

Verdict half_topology_verdict(const Mesh& mesh, const EdgeStar& star) {
    if (star.faces.empty()) return Verdict::kLink;
    std::uint64_t near_goes = 0;
    for (VertexId v : star.link) near_goes |= bit_of(v);
    bool met = true;
    mesh.for_star(star.stays, [&](FaceId f, int place) {
        const auto& v = mesh[f].vertices;
        const VertexId x = v[(place + 1) % 3], y = v[(place + 2) % 3];
        if (x == star.goes || y == star.goes || ((bit_of(x) | bit_of(y)) & near_goes) == 0) return;
        const bool has_x = contains(star.link, x), has_y = contains(star.link, y);
        if ((has_x && !contains(star.apexes, x)) || (has_y && !contains(star.apexes, y))) met = false;
        if (!has_x || !has_y) return;
        for (const StarFace& g : star.faces)
            if ((g.a == x && g.b == y) || (g.a == y && g.b == x)) met = false;
    });
    if (!met || (mesh[star.goes].label_count > 2 && closes_loop_of_lines(mesh, star))) return Verdict::kLink;
    return lands_on_box_edge(mesh, star) ? Verdict::kLink : Verdict::kAccepted;
}

ShapeResult shape_verdict(EdgeStar& star, Vec3 position, const ShapeBounds& bounds) {
    set_normals(star, position);
    if (folds(star, bounds)) return {Verdict::kFold, 0};
    const double bound3 = cube_of_bound(bounds);
    const Lanes3<Double2> merged = both(position);
    double worst3 = 1;
    int below = 0;
    for (std::size_t n = 0; n < star.pairs.size(); ++n) {
        const StarPair& pair = star.pairs[n];
        const Double2 own3 = quality3(pair, pair.a - merged, pair.b - merged, pair.new_length2);
        for (int lane = 0; lane < 2; ++lane) {
            if (own3[lane] < worst3) worst3 = own3[lane];
            below += own3[lane] < bound3 && 2 * static_cast<int>(n) + lane < star.face_count();
        }
    }
    if (below > 0 && !was_worse(star, {worst3, below}, bound3)) return {Verdict::kQuality, worst3};
    if (pinches_at_spokes(star, bounds.min_dihedral_cosine)) return {Verdict::kPinch, 0};
    return {Verdict::kAccepted, worst3};
}

double fan_quality3(const EdgeStar& around, VertexId target, Vec3 at_target, const ShapeBounds& bounds) {
    const Lanes3<Double2> merged = both(at_target);
    const Double2 turn = both(bounds.min_turn_cosine * bounds.min_turn_cosine), bound3 = both(cube_of_bound(bounds));
    double worst3 = 1;
    for (int first = 0; first < around.face_count(); first += 2) {
        const StarPair& pair = around.pairs[first / 2];
        const Lanes3<Double2> to_a = pair.a - merged, to_b = pair.b - merged, normal = cross(to_a, to_b);
        const Double2 normal2 = dot(normal, normal);
        const Double2 own3 = quality3(pair, to_a, to_b, normal2);
        const unsigned good =
            bits_of(are_above(dot(pair.old_normal, normal), turn * pair.old_length2 * normal2) & (own3 >= bound3));
        for (int lane = 0; lane < 2 && first + lane < around.face_count(); ++lane) {
            const StarFace& face = around.faces[first + lane];
            if (face.a == target || face.b == target) continue;  // vanishes
            if ((good >> lane & 1) == 0) return 0;
            worst3 = std::min<double>(worst3, own3[lane]);
        }
    }
    return worst3;
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

bool pinches_at_link(const Mesh& mesh, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds) {
    for (int n = 0; n < star.face_count(); ++n) {
        const StarFace& f = star.faces[n];
        bool pinched = false;
        mesh.for_star(f.a, [&](FaceId g, int place) {
            const auto& v = mesh[g].vertices;
            const VertexId after = v[(place + 1) % 3], before = v[(place + 2) % 3];
            if (pinched || (after != f.b && before != f.b)) return;
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
        const VertexId after = v[(place + 1) % 3], before = v[(place + 2) % 3];
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

bool pinches_around(const Mesh& mesh, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds) {
    return pinches_at_link(mesh, star, position, bounds) || (star.keeps_stays && pinches_at_stays(mesh, star, bounds));
}

}  // namespace regionmesh
