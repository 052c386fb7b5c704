#include "cells/table/any_position.h"

#include <algorithm>

namespace regionmesh::cell_table {

unsigned sides_of(NodeSet simplex) {
    unsigned all = 7, any = 0;
    for (unsigned n = 0; n < 8; ++n)
        if (simplex >> n & 1) {
            all &= n;
            any |= n;
        }
    return all | (7 & ~any) << 3;
}

std::vector<AnyPosition::Corner> AnyPosition::range_of(NodeSet simplex) {
    const int count = std::popcount(static_cast<unsigned>(simplex));
    const bool is_inner = count == 3 && (simplex & kMainDiagonal) == kMainDiagonal;
    const int least = is_inner ? kTenths : 0;
    std::vector<Corner> corners;
    for (int c = 0; c < 8; ++c) {
        if (!(simplex >> c & 1)) continue;
        Corner& corner = corners.emplace_back();
        for (int n = 0; n < 8; ++n) {
            if (!(simplex >> n & 1)) continue;
            const int weight = n == c ? 10 - (count - 1) * least : least;
            for (int axis = 0; axis < 3; ++axis) corner[axis] += weight * (n >> axis & 1);
        }
    }
    return corners;
}

AnyPosition::Side AnyPosition::side(const Triangle& plane, NodeSet point) {
    const std::uint32_t key =
        plane[0] | std::uint32_t{plane[1]} << 8 | std::uint32_t{plane[2]} << 16 | std::uint32_t{point} << 24;
    const auto [known, is_new] = sides_.try_emplace(key, Side::kOn);
    if (!is_new) return known->second;
    const auto ranges = {range_of(plane[0]), range_of(plane[1]), range_of(plane[2]), range_of(point)};
    bool above = false, below = false;
    for (const Corner& a : ranges.begin()[0])
        for (const Corner& b : ranges.begin()[1])
            for (const Corner& c : ranges.begin()[2])
                for (const Corner& d : ranges.begin()[3]) {
                    const auto from_a = [&](const Corner& p) { return Corner{p[0] - a[0], p[1] - a[1], p[2] - a[2]}; };
                    const Corner u = from_a(b), v = from_a(c), w = from_a(d);
                    const std::int64_t volume = u[0] * (v[1] * w[2] - v[2] * w[1]) -
                                                u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
                    above |= volume > 0;
                    below |= volume < 0;
                }
    // Not negative at all corners and not zero everywhere: positive in the interior.
    const Side found = above && below ? Side::kDepends : above ? Side::kAbove : below ? Side::kBelow : Side::kOn;
    return known->second = found;
}

/// The vertices of `a` that are not on the plane lie strictly on one side of it, those of `b` on the other. On the
/// plane the triangles have a vertex, or an edge, of theirs each.
bool AnyPosition::parts(const Triangle& plane, const Triangle& a, const Triangle& b) {
    Side side_of[2] = {Side::kOn, Side::kOn};
    bool has_own[2] = {}, is_spanned = true;
    for (int t = 0; t < 2; ++t) {
        const Triangle& own = t == 0 ? a : b;
        const Triangle& other = t == 0 ? b : a;
        for (NodeSet vertex : own) {
            bool is_on = has(plane, vertex);
            if (!is_on) {
                const Side found = side(plane, vertex);
                if (found == Side::kDepends || (found != Side::kOn && side_of[t] != Side::kOn && found != side_of[t]))
                    return false;
                is_on = found == Side::kOn;
                if (is_on)
                    is_spanned = false;
                else
                    side_of[t] = found;
            }
            has_own[t] |= is_on && !has(other, vertex);
        }
    }
    if (side_of[0] == side_of[1]) return false;
    // Their common points on the plane are shared, or spanned by three points that are not on one line.
    return is_spanned || !has_own[0] || !has_own[1];
}

bool AnyPosition::are_apart(const Triangle& first, const Triangle& second) {
    Triangle a = first, b = second;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    if (b < a) std::swap(a, b);
    const auto [known, is_new] = apart_.try_emplace({a, b}, false);
    if (!is_new) return known->second;
    std::vector<NodeSet> points(a.begin(), a.end());
    for (NodeSet vertex : b)
        if (!has(a, vertex)) points.push_back(vertex);
    for (int n = 0; n < 8; ++n) points.push_back(static_cast<NodeSet>(1 << n));
    for (std::size_t p = 0; p < points.size(); ++p)
        for (std::size_t q = p + 1; q < points.size(); ++q)
            for (std::size_t r = q + 1; r < points.size(); ++r)
                if (parts({points[p], points[q], points[r]}, a, b)) return known->second = true;
    return false;
}

}  // namespace regionmesh::cell_table
