#include "regionmesh/model/face_meeting.h"

#include "regionmesh/model/exact_predicates.h"

namespace regionmesh {

bool meet_outside_shared(const PlacedFace& f, const PlacedFace& g) {
    const auto &p = f.at, &q = g.at;
    if (!boxes_overlap(p, q)) return false;
    std::array<int, 3> in_g{-1, -1, -1};  // where each corner of f is in g
    int shared = 0, own = -1, common = -1;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            if (f.vertices[i] == g.vertices[j]) in_g[i] = j;
        if (in_g[i] >= 0) {
            ++shared;
            common = i;
        } else {
            own = i;
        }
    }
    if (shared == 0) return meet({p[0], p[1], p[2]}, {q[0], q[1], q[2]});
    if (shared == 1)
        return meet_beyond_vertex(p[common], p[(common + 1) % 3], p[(common + 2) % 3], q[(in_g[common] + 1) % 3],
                                  q[(in_g[common] + 2) % 3]);
    if (shared == 2) {
        const int a = (own + 1) % 3, b = (own + 2) % 3;
        return meet_beyond_edge(p[a], p[b], p[own], q[3 - in_g[a] - in_g[b]]);
    }
    return true;
}

}  // namespace regionmesh
