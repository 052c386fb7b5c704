#include "improve/edge_flips.h"

#include <algorithm>

#include "improve/fan_shape.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {
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

EdgeFlips::EdgeFlips(Judge& judge, SurfaceDrift& drift, double poor)
    : judge_(judge), mesh_(judge.mesh()), drift_(drift), poor3_(poor * poor * poor) {}

std::optional<Flip> EdgeFlips::try_flip(FaceId f, int place) {
    const std::optional<Flip> flip = find_flip(mesh_, f, place);
    if (!flip || !is_flippable(*flip)) return {};
    const Vec3 u = mesh_.position(flip->u), v = mesh_.position(flip->v), c = mesh_.position(flip->c),
               d = mesh_.position(flip->d);
    FanShape before, after;
    before.add(c, u, v);
    before.add(d, v, u);
    after.add(c, u, d);
    after.add(c, d, v);
    if (!after.is_better_than(before) || !propose_flip(mesh_, *flip, change_)) return {};
    const float drift = std::max({drift_.of(flip->u), drift_.of(flip->v), drift_.of(flip->c), drift_.of(flip->d)});
    const double step = change_.flip_error.height;
    if (!drift_.may_move(drift, step, before.worst3 < poor3_) ||
        examine(judge_, change_, [&] { return Places{c}; }) != Verdict::kAccepted)
        return {};
    judge_.apply(change_);
    for (VertexId w : {flip->c, flip->d}) drift_.set(w, drift, step);
    return change_.flip;
}

/// Vertices whose faces may be elsewhere keep them.
bool EdgeFlips::is_flippable(const Flip& flip) const {
    for (VertexId v : {flip.u, flip.v, flip.c, flip.d})
        if (mesh_[v].is_fixed) return false;
    return flip.c != flip.d;
}

}  // namespace regionmesh
