#include "judge/edge_star.h"

#include <algorithm>

#include "mesh/strata.h"

namespace regionmesh {
namespace {

void add_surviving(const Mesh& mesh, FaceId f, int place, EdgeStar& star) {
    const auto& v = mesh[f].vertices;
    star.faces.push_back({f, v[place_after(place)], v[place_before(place)], v[place]});
}

/// The measures that do not depend on where the merged vertex goes.
void measure(const Mesh& mesh, EdgeStar& star) {
    const std::size_t count = star.faces.size();
    star.pairs.resize((count + 1) / 2);
    Lanes3<Double2> low = both(Vec3{HUGE_VAL, HUGE_VAL, HUGE_VAL}), high = both(Vec3{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL});
    for (std::size_t n = 0; n < star.pairs.size(); ++n) {
        StarPair& pair = star.pairs[n];
        const std::size_t first = 2 * n, second = std::min(2 * n + 1, count - 1);
        const StarFace &f = star.faces[first], &g = star.faces[second];
        pair.a = side_by_side(mesh.position(f.a), mesh.position(g.a));
        pair.b = side_by_side(mesh.position(f.b), mesh.position(g.b));
        const Lanes3<Double2> apex =
            side_by_side(star.at_apex(static_cast<int>(first)), star.at_apex(static_cast<int>(second)));
        pair.old_normal = cross(pair.a - apex, pair.b - apex);
        pair.old_length2 = dot(pair.old_normal, pair.old_normal);
        const Lanes3<Double2> link_edge = pair.b - pair.a;
        pair.link_length2 = dot(link_edge, link_edge);
        low = {least(least(low.x, pair.a.x), pair.b.x), least(least(low.y, pair.a.y), pair.b.y),
               least(least(low.z, pair.a.z), pair.b.z)};
        high = {greatest(greatest(high.x, pair.a.x), pair.b.x), greatest(greatest(high.y, pair.a.y), pair.b.y),
                greatest(greatest(high.z, pair.a.z), pair.b.z)};
    }
    star.link_box = {min(low[0], low[1]), max(high[0], high[1])};
}

/// All faces have the same two labels, those that vanish, too: a spike at an open rim may be all that its interface has
/// here.
bool is_one_interface(const Mesh& mesh, const EdgeStar& star) {
    if (star.faces.empty()) return true;
    const auto& labels = mesh[star.faces[0].face].labels;
    return std::all_of(star.faces.begin(), star.faces.end(),
                       [&](const StarFace& f) { return mesh[f.face].has_labels(labels); }) &&
           std::all_of(star.dead.begin(), star.dead.end(), [&](FaceId f) { return mesh[f].has_labels(labels); });
}

void add_to_link(EdgeStar& star, VertexId v) {
    bool has = false;  // one branch in all
    for (VertexId other : star.link) has |= other == v;
    if (!has) star.link.push_back(v);
}

/// Round an edge within one interface every vertex of the link comes first in exactly one face, but the last of an open
/// fan.
void gather_link(const Mesh& mesh, EdgeStar& star) {
    const bool is_inside = mesh[star.goes].label_count == 2 && (star.keeps_stays || mesh[star.stays].label_count == 2);
    for (const StarFace& face : star.faces) {
        if (is_inside) {
            star.link.push_back(face.a);
        } else {
            add_to_link(star, face.a);
            add_to_link(star, face.b);
        }
    }
    if (is_inside && star.keeps_stays)
        for (VertexId apex : star.apexes) add_to_link(star, apex);
}

void start(const Mesh& mesh, StarKind kind, VertexId goes, VertexId stays, EdgeStar& star) {
    star.kind = kind;
    star.goes = goes;
    star.stays = stays;
    star.at_goes = mesh.position(goes);
    star.at_stays = mesh.position(stays == kNoVertex ? goes : stays);
    star.faces.clear();
    star.dead.clear();
    star.apexes.clear();
    star.link.clear();
}

void add_faces_of_goes(const Mesh& mesh, EdgeStar& star) {
    mesh.for_star(star.goes, [&](FaceId f, int place) {
        const Face& face = mesh[f];
        const VertexId a = face.vertices[place_after(place)], b = face.vertices[place_before(place)];
        if (a != star.stays && b != star.stays) return add_surviving(mesh, f, place, star);
        star.dead.push_back(f);
        star.apexes.push_back(a == star.stays ? b : a);
    });
}

void gather_faces_of_goes(const Mesh& mesh, StarKind kind, VertexId goes, VertexId stays, EdgeStar& star) {
    start(mesh, kind, goes, stays, star);
    star.keeps_stays = true;
    add_faces_of_goes(mesh, star);
    star.is_interface = is_one_interface(mesh, star);
    measure(mesh, star);
}

/// Are these multiples of 1/64, and less than 2^45? Their differences are exact.
bool are_of_few_digits(const Lanes3<Double2>& p) {
    // Adding 1.5 * 2^46 leaves no digits beyond 1/64.
    const Double2 round = both(0x1.8p46), most = both(0x1p45), zero = both(0);
    unsigned ok = 3;
    for (Double2 x : {p.x, p.y, p.z}) ok &= bits_of(((x + round) - round == x) & (greatest(x, zero - x) < most));
    return ok == 3;
}

/// Do all corners lie in one plane, exactly? True only where the coordinates have few digits, as those of samples do,
/// and lie less than 64 apart: products of three differences are exact then.
bool is_in_one_plane(const EdgeStar& star) {
    const Lanes3<Double2> origin = both(star.at_goes), normal = both(star.pairs[0].old_normal[0]);
    const auto is_in_plane = [&](const Lanes3<Double2>& p) {
        const Lanes3<Double2> step = p - origin;
        const Double2 most = both(64), zero = both(0);
        unsigned is_near = 3;
        for (Double2 x : {step.x, step.y, step.z}) is_near &= bits_of(greatest(x, zero - x) < most);
        return is_near == 3 && are_of_few_digits(p) && bits_of(dot(normal, step) == zero) == 3;
    };
    return are_of_few_digits(origin) && is_in_plane(both(star.at_stays)) &&
           std::all_of(star.pairs.begin(), star.pairs.end(),
                       [&](const StarPair& pair) { return is_in_plane(pair.a) && is_in_plane(pair.b); });
}

}  // namespace

void gather(const Mesh& mesh, VertexId goes, VertexId stays, EdgeStar& star) {
    start(mesh, StarKind::kCollapse, goes, stays, star);
    star.keeps_stays = false;
    add_faces_of_goes(mesh, star);
    mesh.for_star(stays, [&](FaceId f, int place) {
        const Face& face = mesh[f];
        if (face.vertices[place_after(place)] != goes && face.vertices[place_before(place)] != goes)
            add_surviving(mesh, f, place, star);
    });
    star.is_interface = is_one_interface(mesh, star);
    measure(mesh, star);
    gather_link(mesh, star);
}

void gather_vertex(const Mesh& mesh, VertexId goes, EdgeStar& star) {
    gather_faces_of_goes(mesh, StarKind::kVertex, goes, kNoVertex, star);
}

void gather_half(const Mesh& mesh, VertexId goes, VertexId stays, EdgeStar& star) {
    gather_faces_of_goes(mesh, StarKind::kHalf, goes, stays, star);
    gather_link(mesh, star);
}

void gather_move(const Mesh& mesh, VertexId v, EdgeStar& star) {
    gather_faces_of_goes(mesh, StarKind::kMove, v, kNoVertex, star);
    star.stays = v;
    star.keeps_stays = false;
    for (const StarFace& face : star.faces) {
        add_to_link(star, face.a);
        add_to_link(star, face.b);
    }
}

void gather_flip(const Mesh& mesh, const Flip& flip, EdgeStar& star) {
    start(mesh, StarKind::kFlip, flip.c, flip.c, star);
    star.at_goes = 0.5 * (mesh.position(flip.u) + mesh.position(flip.v));
    star.keeps_stays = true;
    star.is_interface = true;
    star.faces = {{flip.g, flip.u, flip.d, flip.c}, {flip.g, flip.d, flip.v, flip.c}};
    star.link = {flip.u, flip.d, flip.v};
    measure(mesh, star);
}

void gather_split(const Mesh& mesh, VertexId u, VertexId v, VertexId m, EdgeStar& star, std::vector<FaceId>& split) {
    start(mesh, StarKind::kSplit, m, m, star);
    star.keeps_stays = false;
    split.clear();
    mesh.for_star(u, [&](FaceId f, int place) {
        const auto& corners = mesh[f].vertices;
        const VertexId after = corners[place_after(place)], before = corners[place_before(place)];
        if (after != v && before != v) return;
        split.push_back(f);
        const VertexId apex = after == v ? before : after;
        if (after == v) {  // (u, v, apex) becomes (m, apex, u) and (m, v, apex)
            star.faces.push_back({f, apex, u, m});
            star.faces.push_back({f, v, apex, m});
        } else {  // (u, apex, v) becomes (m, u, apex) and (m, apex, v)
            star.faces.push_back({f, u, apex, m});
            star.faces.push_back({f, apex, v, m});
        }
    });
    star.is_interface = is_one_interface(mesh, star);
    measure(mesh, star);
    for (const StarFace& face : star.faces) {
        add_to_link(star, face.a);
        add_to_link(star, face.b);
    }
}

void gather_line_ends(const Mesh& mesh, const EdgeStar& star, std::vector<VertexId>& ends) {
    ends.clear();
    for (const VertexId w : star.link)
        if (mesh[w].label_count > 2 && edge_labels(mesh, star.goes, w).size() > 2) ends.push_back(w);
}

void set_normals(EdgeStar& star, Vec3 position) {
    const Lanes3<Double2> merged = both(position);
    for (StarPair& pair : star.pairs) {
        pair.new_normal = cross(pair.a - merged, pair.b - merged);
        pair.new_length2 = dot(pair.new_normal, pair.new_normal);
    }
}

void note_flat(EdgeStar& star, Vec3 position) {
    const auto stays_level = [&](int axis) { return star.is_level(axis) && position[axis] == star.at_goes[axis]; };
    star.is_flat = star.is_interface &&
                   (stays_level(0) || stays_level(1) || stays_level(2) || (star.keeps_stays && is_in_one_plane(star)));
}

}  // namespace regionmesh
