#include "mesh/face_meeting.h"

#include "base/exact_predicates.h"

namespace regionmesh {

bool are_apart(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q) {
    // Relative to one corner, to reduce rounding.
    const Vec3 a = p[1] - p[0], b = p[2] - p[0], x = q[0] - p[0], y = q[1] - p[0], z = q[2] - p[0];
    const double doubt = 1e-12 * (size_of(a) + size_of(b) + size_of(x) + size_of(y) + size_of(z));
    const auto is_between = [](double u, double v, double r, double s, double t, double slack) {
        const double p_high = std::max({0.0, u, v}), p_low = std::min({0.0, u, v});
        return std::min({r, s, t}) > p_high + slack || std::max({r, s, t}) < p_low - slack;
    };
    const Vec3 d = x + y + z - a - b;
    if (is_between(dot(d, a), dot(d, b), dot(d, x), dot(d, y), dot(d, z), size_of(d) * doubt + 1e-290)) return true;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (is_between(a[i] + a[j], b[i] + b[j], x[i] + x[j], y[i] + y[j], z[i] + z[j], doubt) ||
            is_between(a[i] - a[j], b[i] - b[j], x[i] - x[j], y[i] - y[j], z[i] - z[j], doubt))
            return true;
    }
    return false;
}

bool meet_outside_shared(const PlacedFace& f, const PlacedFace& g) {
    const auto &p = f.at, &q = g.at;
    if (!boxes_overlap(p, q)) return false;
    std::array<int, 3> in_g{-1, -1, -1};  // the index of each corner of f in g
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
