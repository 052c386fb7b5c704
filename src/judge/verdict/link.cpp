#include <algorithm>

#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

bool contains(const std::vector<VertexId>& set, VertexId v) {
    bool has = false;  // without branches, which would be mispredicted
    for (VertexId other : set) has |= other == v;
    return has;
}

std::uint64_t bit_of(VertexId v) { return std::uint64_t{1} << (index(v) & 63); }

/// Every common neighbour of the ends must be an apex of the edge, and they may have no link edge in common.
bool is_met_by_edge(const EdgeStar& star) {
    // Only apexes are common to most: a bit for each neighbour of the end that goes, by id modulo 64. Its faces come
    // first. Few branches: most would be mispredicted.
    std::uint64_t near_goes = 0;
    bool met = true;
    for (const StarFace& f : star.faces)
        if (f.apex == star.goes) near_goes |= bit_of(f.a) | bit_of(f.b);
    for (const StarFace& g : star.faces) {
        if (g.apex != star.stays || ((bit_of(g.a) | bit_of(g.b)) & near_goes) == 0) continue;
        const bool a_is_apex = contains(star.apexes, g.a), b_is_apex = contains(star.apexes, g.b);
        for (const StarFace& f : star.faces) {
            if (f.apex != star.goes) break;
            const bool has_a = (f.a == g.a) | (f.b == g.a), has_b = (f.a == g.b) | (f.b == g.b);
            met &= !((has_a & has_b) | (has_a & !a_is_apex) | (has_b & !b_is_apex));
        }
    }
    return met;
}

/// The same where only the faces of `goes` are in the star (gather_half): those of `stays` are looked up.
bool is_met_by_half(const Mesh& mesh, const EdgeStar& star) {
    std::uint64_t near_goes = 0;
    for (VertexId v : star.link) near_goes |= bit_of(v);
    bool met = true;
    mesh.for_star(star.stays, [&](FaceId f, int place) {
        const auto& v = mesh[f].vertices;
        const VertexId x = v[place_after(place)], y = v[place_before(place)];
        if ((x == star.goes) | (y == star.goes) | (((bit_of(x) | bit_of(y)) & near_goes) == 0)) return;
        const bool has_x = contains(star.link, x), has_y = contains(star.link, y);
        if ((has_x && !contains(star.apexes, x)) || (has_y && !contains(star.apexes, y))) met = false;
        if (!has_x || !has_y) return;
        for (const StarFace& g : star.faces)
            if ((g.a == x && g.b == y) || (g.a == y && g.b == x)) met = false;
    });
    return met;
}

/// Would a vertex lose its last face, as at a rim that is none of the box?
bool strips_apex(const Mesh& mesh, const EdgeStar& star) {
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        bool has_other = false;
        for (const StarFace& face : star.faces) has_other |= (face.a == apex) | (face.b == apex);
        if (!has_other)
            mesh.for_star(apex, [&](FaceId f, int) {
                has_other |= std::find(star.dead.begin(), star.dead.end(), f) == star.dead.end();
            });
        return !has_other;
    });
}

/// Two lines that leave the ends of a line edge must not meet in the next vertex.
bool closes_loop_of_lines(const Mesh& mesh, const EdgeStar& star) {
    return std::any_of(star.apexes.begin(), star.apexes.end(), [&](VertexId apex) {
        return edge_labels(mesh, star.goes, apex).size() > 2 && edge_labels(mesh, star.stays, apex).size() > 2;
    });
}

/// Would the collapse move an edge onto an edge of the box? Where the box has faces this is a loop of
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

/// Are the vertices that a flip joins neighbours already, or would its edge lie in a side of the box that has none of
/// the old edge?
bool joins_neighbours(const Mesh& mesh, const Flip& flip) {
    const SideSet made = mesh[flip.c].sides & mesh[flip.d].sides, gone = mesh[flip.u].sides & mesh[flip.v].sides;
    if ((made & ~gone) != 0) return true;
    bool are_joined = false;
    mesh.for_star(flip.c, [&](FaceId f, int) {
        for (VertexId v : mesh[f].vertices) are_joined |= v == flip.d;
    });
    return are_joined;
}

}  // namespace

Verdict test_link(const Judge& judge, Change& change) {
    const Mesh& mesh = judge.mesh();
    const EdgeStar& star = change.star;
    if (star.kind == StarKind::kMove || star.kind == StarKind::kSplit) return Verdict::kAccepted;
    if (change.is_flip()) return joins_neighbours(mesh, change.flip) ? Verdict::kLink : Verdict::kAccepted;
    if (star.faces.empty()) return Verdict::kLink;
    const bool is_met = star.keeps_stays ? is_met_by_half(mesh, star) : is_met_by_edge(star);
    if (!is_met || strips_apex(mesh, star)) return Verdict::kLink;
    if (mesh[star.goes].label_count > 2 && closes_loop_of_lines(mesh, star)) return Verdict::kLink;
    return lands_on_box_edge(mesh, star) ? Verdict::kLink : Verdict::kAccepted;
}

}  // namespace regionmesh
