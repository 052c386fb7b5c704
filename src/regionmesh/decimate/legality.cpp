#include "regionmesh/decimate/legality.h"

#include <algorithm>

#include "regionmesh/base/triangle.h"
#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/strata.h"

namespace regionmesh {
namespace {

bool contains(const std::vector<VertexId>& set, VertexId v) {
    return std::find(set.begin(), set.end(), v) != set.end();
}

/// Every common neighbour of the ends must be an apex of the edge, and they may have no link edge in common.
bool is_link_condition_met(const EdgeStar& star) {
    for (const StarFace& f : star.faces) {
        if (f.apex != star.goes) continue;
        for (const StarFace& g : star.faces) {
            if (g.apex != star.stays) continue;
            const bool shares_a = f.a == g.a || f.a == g.b, shares_b = f.b == g.a || f.b == g.b;
            if (shares_a && shares_b) return false;
            if ((shares_a && !contains(star.apexes, f.a)) || (shares_b && !contains(star.apexes, f.b))) return false;
        }
    }
    return true;
}

/// Two lines that leave the ends of a line edge must not meet in the next vertex.
bool closes_loop_of_lines(const Model& model, const EdgeStar& star) {
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return edge_labels(model, star.goes, apex).size() > 2 && edge_labels(model, star.stays, apex).size() > 2;
    });
}

/// Would an edge come to lie on an edge of the box that lay beside it before? Where the box has faces this is a loop of
/// lines; where it has none (not capped, or background) the rim of a sheet would close on itself unseen.
bool lands_on_box_edge(const Model& model, const EdgeStar& star) {
    const SideSet stays = model[star.stays].sides, both = stays & model[star.goes].sides;
    const auto is_on_edge = [](unsigned sides) { return (sides & (sides - 1)) != 0; };
    if (!is_on_edge(stays)) return false;
    return std::any_of(star.link.begin(), star.link.end(), [&](VertexId v) {
        const SideSet sides = model[v].sides;
        if (!is_on_edge(stays & sides) || is_on_edge(both & sides) || contains(star.apexes, v)) return false;
        return std::any_of(star.faces.begin(), star.faces.end(),
                           [&](const StarFace& f) { return f.apex == star.goes && (f.a == v || f.b == v); });
    });
}

/// Two faces that pass their common edge in opposite directions look the same way; their normals then are as the angle
/// between their pages, from the other side.
bool is_pinched(Vec3 n, double n_length, Vec3 m, double m_length, bool opposite, double max_cosine) {
    const double cosine = opposite ? -dot(n, m) : dot(n, m);
    return cosine > max_cosine * n_length * m_length;
}

/// All new faces look at most 60 degrees away from their mean: no two of a disk are near to closing.
bool is_nearly_flat(const EdgeStar& star) {
    Vec3 sum;
    for (const StarFace& f : star.faces) sum += f.new_normal;
    const double bound = 0.5 * length(sum);
    return std::all_of(star.faces.begin(), star.faces.end(),
                       [&](const StarFace& f) { return dot(f.new_normal, sum) > bound * f.new_length; });
}

/// Pages at the edges from the merged vertex.
bool pinches_at_spokes(const Model& model, const EdgeStar& star, double max_cosine) {
    const auto& labels = model[star.dead.front()].labels;
    const bool is_disk = std::all_of(star.faces.begin(), star.faces.end(),
                                     [&](const StarFace& f) { return model[f.face].labels == labels; });
    if (is_disk && is_nearly_flat(star)) return false;
    for (std::size_t i = 0; i < star.faces.size(); ++i) {
        const StarFace& f = star.faces[i];
        for (std::size_t j = i + 1; j < star.faces.size(); ++j) {
            const StarFace& g = star.faces[j];
            const bool opposite = (f.a == g.b) | (f.b == g.a);
            const bool same = (f.a == g.a) | (f.b == g.b);
            if (!(opposite | same)) continue;
            if (is_pinched(f.new_normal, f.new_length, g.new_normal, g.new_length, opposite, max_cosine)) return true;
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

/// Pages at the edges of the link: each new face against the faces outside the star that it hangs on to.
bool pinches_at_link(const Model& model, const EdgeStar& star, Vec3 position, double max_cosine) {
    for (const StarFace& f : star.faces) {
        bool pinched = false;
        model.for_star(f.a, [&](FaceId g, int place) {
            const auto& v = model[g].vertices;
            const VertexId after = v[(place + 1) % 3], before = v[(place + 2) % 3];
            if (pinched || (after != f.b && before != f.b)) return;
            const VertexId third = after == f.b ? before : after;
            if (third == star.goes || third == star.stays) return;
            const bool opposite = before == f.b;
            const Vec3 x = model.position(third);
            const Vec3 m = opposite ? area_vector(f.at_b, f.at_a, x) : area_vector(f.at_a, f.at_b, x);
            const double toward = opposite ? -dot(m, f.new_normal) : dot(m, f.new_normal);
            if (toward <= 0) return;
            pinched = is_pinched(f.new_normal, f.new_length, m, length(m), opposite, max_cosine) ||
                      sweeps_over(f.at_a, f.at_b, model.position(f.apex), position, x);
        });
        if (pinched) return true;
    }
    return false;
}

}  // namespace

Verdict topology_verdict(const Model& model, const EdgeStar& star) {
    const int edge_count = edge_labels(model, star.goes, star.stays).size();
    if (edge_count != vertex_labels(model, star.goes).size()) return Verdict::kStrata;
    if (star.faces.empty() || !is_link_condition_met(star)) return Verdict::kLink;
    if (edge_count > 2 && closes_loop_of_lines(model, star)) return Verdict::kLink;
    if (lands_on_box_edge(model, star)) return Verdict::kLink;
    return Verdict::kAccepted;
}

void set_normals(EdgeStar& star, Vec3 position) {
    for (StarFace& f : star.faces) {
        f.new_normal = area_vector(position, f.at_a, f.at_b);
        f.new_length = length(f.new_normal);
    }
}

ShapeResult shape_verdict(const Model& model, EdgeStar& star, Vec3 position, const ShapeBounds& bounds) {
    set_normals(star, position);
    for (const StarFace& f : star.faces) {
        if (!(dot(f.old_normal, f.new_normal) > bounds.min_turn_cosine * f.old_length * f.new_length))
            return {Verdict::kFold, 0};
    }
    if (pinches_at_spokes(model, star, bounds.min_dihedral_cosine) ||
        pinches_at_link(model, star, position, bounds.min_dihedral_cosine))
        return {Verdict::kPinch, 0};
    double worst = 1;
    for (const StarFace& f : star.faces) {
        const QualityTerms terms = quality_terms(0.5 * f.new_length, length2(f.at_a - position),
                                                 length2(f.at_b - position), length2(f.at_b - f.at_a));
        const double quality = terms.value();
        worst = std::min(worst, quality);
        if (quality >= bounds.min_quality) continue;
        if (!(quality > face_quality(model.position(f.apex), f.at_a, f.at_b))) return {Verdict::kQuality, quality};
    }
    return {Verdict::kAccepted, worst};
}

}  // namespace regionmesh
