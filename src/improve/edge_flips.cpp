#include "improve/edge_flips.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/box.h"
#include "improve/fan_shape.h"
#include "judge/verdict/samples.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

/// The edge of f opposite to `place`, if it has two faces, of one interface and of the same direction.
std::optional<Flip> find_flip(const Mesh& mesh, FaceId f, int place) {
    const auto& own = mesh[f].vertices;
    Flip flip{
        .f = f, .g = f, .u = own[place_after(place)], .v = own[place_before(place)], .c = own[place], .d = kNoVertex};
    int count = 0;
    mesh.for_star(flip.u, [&](FaceId g, int at) {
        const auto& v = mesh[g].vertices;
        const VertexId after = v[(at + 1) % 3], before = v[(at + 2) % 3];
        if (after != flip.v && before != flip.v) return;
        ++count;
        if (before != flip.v) return;  // f itself, or a face of another direction
        flip.g = g;
        flip.d = after;
    });
    if (count != 2 || flip.d == kNoVertex || mesh[flip.g].labels != mesh[f].labels) return {};
    return flip;
}

bool are_joined(const Mesh& mesh, VertexId a, VertexId b) {
    bool joined = false;
    mesh.for_star(a, [&](FaceId f, int) {
        for (VertexId v : mesh[f].vertices) joined |= v == b;
    });
    return joined;
}

}  // namespace

/// The bound on quality is FanShape's, and samples are looked at for the flip itself.
EdgeFlips::EdgeFlips(Mesh& mesh, FaceTree& tree, SurfaceDrift& drift, const ImproveOptions& options)
    : mesh_(mesh),
      tree_(tree),
      drift_(drift),
      options_(options),
      bound3_(options.min_quality * options.min_quality * options.min_quality),
      collapse_{.mesh = mesh, .tree = &tree, .bounds = {.min_quality = 0}} {}

std::optional<Flip> EdgeFlips::try_flip(FaceId f, int place) {
    std::optional<Flip> flip = find_flip(mesh_, f, place);
    if (!flip || !is_flippable(*flip)) return {};
    const Vec3 u = mesh_.position(flip->u), v = mesh_.position(flip->v), c = mesh_.position(flip->c),
               d = mesh_.position(flip->d);
    FanShape before, after;
    before.add(c, u, v);
    before.add(d, v, u);
    after.add(c, u, d);
    after.add(c, d, v);
    if (!after.is_better_than(before)) return {};
    const std::optional<FlipBound> step = flip_bound(mesh_, *flip);
    if (!step || !is_within(step->bound, options_.max_error)) return {};
    const float drift = std::max({drift_.of(flip->u), drift_.of(flip->v), drift_.of(flip->c), drift_.of(flip->d)});
    if (!drift_.may_move(drift, step->height, before.worst3 < bound3_) || are_joined(mesh_, flip->c, flip->d) ||
        is_refused(*flip))
        return {};
    const auto labels = mesh_[f].labels;
    mesh_.remove_face(flip->f);
    mesh_.remove_face(flip->g);
    flip->f = mesh_.add_face(flip->c, flip->u, flip->d, labels[0], labels[1]);
    flip->g = mesh_.add_face(flip->c, flip->d, flip->v, labels[0], labels[1]);
    for (FaceId made : {flip->f, flip->g}) tree_.set(made, box_of(mesh_.corners(made)));
    step->apply(mesh_, *flip);
    for (VertexId w : {flip->c, flip->d}) drift_.set(w, drift, step->height);
    return flip;
}

/// Vertices whose faces may be elsewhere keep them, and no edge moves onto a side of the box, or onto an edge of it.
bool EdgeFlips::is_flippable(const Flip& flip) const {
    for (VertexId v : {flip.u, flip.v, flip.c, flip.d})
        if (mesh_[v].is_fixed) return false;
    const SideSet made = mesh_[flip.c].sides & mesh_[flip.d].sides, gone = mesh_[flip.u].sides & mesh_[flip.v].sides;
    return flip.c != flip.d && (made & ~gone) == 0;
}

bool EdgeFlips::is_refused(const Flip& flip) {
    EdgeStar& star = collapse_.star;
    gather_flip(mesh_, flip, star);
    set_normals(star, mesh_.position(flip.c));
    // `fold` looks at g alone.
    const auto f = mesh_.corners(flip.f);
    const Vec3 normal = area_vector(f[0], f[1], f[2]);
    const double bound = collapse_.bounds.min_turn_cosine * length(normal);
    for (int n = 0; n < 2; ++n)
        if (!(dot(normal, star.new_normal(n)) > bound * length(star.new_normal(n)))) return true;
    if (carries_samples(flip)) return true;
    tree_.remove(flip.f);
    tree_.remove(flip.g);
    const bool is_refused = verdict_at(collapse_, {mesh_.position(flip.c)}) != Verdict::kAccepted;
    for (FaceId old : {flip.f, flip.g}) tree_.set(old, box_of(mesh_.corners(old)));
    return is_refused;
}

bool EdgeFlips::carries_samples(const Flip& flip) const {
    if (!options_.samples) return false;
    const auto& labels = mesh_[flip.f].labels;
    const Vec3 u = mesh_.position(flip.u), v = mesh_.position(flip.v), c = mesh_.position(flip.c),
               d = mesh_.position(flip.d);
    const std::array<LabelledTriangle, 2> before{{{{c, u, v}, labels}, {{d, v, u}, labels}}};
    const std::array<LabelledTriangle, 2> after{{{{c, u, d}, labels}, {{c, d, v}, labels}}};
    return changes_samples(*options_.samples, before, after);
}

}  // namespace regionmesh
