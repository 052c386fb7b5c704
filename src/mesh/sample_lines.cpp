#include "mesh/sample_lines.h"

#include <algorithm>
#include <cmath>

#include "base/exact_predicates.h"

namespace regionmesh {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

struct Point2 {
    double x, y;
};

/// Sign of the area of a, b, c: +1 counter-clockwise. Exact.
int orientation(Point2 a, Point2 b, Point2 c) {
    const Point2 to_a{a.x - c.x, a.y - c.y}, to_b{b.x - c.x, b.y - c.y};
    const double left = to_a.x * to_b.y, right = to_a.y * to_b.x, area = left - right;
    const double bound = 3.3306690738754716e-16 * (std::abs(left) + std::abs(right));  // Shewchuk (1997), orient2d A
    if (area > bound || -area > bound) return sign(area);
    // Both products have a factor that is exactly 0: common on the lattice.
    if ((to_a.x == 0 || to_b.y == 0) && (to_a.y == 0 || to_b.x == 0)) return 0;
    return exact_orientation({a.x, a.y, 0}, {b.x, b.y, 0}, {c.x, c.y, 0}, {c.x, c.y, 1});
}

/// The same with c moved along `nudge` by infinitely small lengths, that along x much longer than that along y or the
/// other way round; 0 only where a is b.
int orientation(Point2 a, Point2 b, Point2 c, Point2 nudge, bool is_x_longer) {
    if (const int plain = orientation(a, b, c)) return plain;
    const int along_x = sign(a.y - b.y) * sign(nudge.x), along_y = sign(b.x - a.x) * sign(nudge.y);
    if (is_x_longer) return along_x != 0 ? along_x : along_y;
    return along_y != 0 ? along_y : along_x;
}

/// Signs of the normal of a triangle, exact.
std::array<int, 3> normal_signs(const std::array<Vec3, 3>& p) {
    const auto side = [&](int u, int v) {
        return orientation(Point2{p[0][u], p[0][v]}, Point2{p[1][u], p[1][v]}, Point2{p[2][u], p[2][v]});
    };
    return {side(1, 2), side(2, 0), side(0, 1)};
}

}  // namespace

SampleLines::SampleLines(const Lattice& lattice, const std::array<int, 3>& axes) {
    for (int n = 0; n < 3; ++n) {
        size_[n] = lattice.size[axes[n]];
        turn_[n] = size_[n] - 1;
        origin_[n] = lattice.origin[axes[n]];
        spacing_[n] = lattice.spacing[axes[n]];
    }
    // The longest along y of the lattice, then z, then x.
    for (int n = 0; n < 3; ++n) by_nudge_[(axes[n] + 2) % 3] = n;
}

void SampleLines::turn_back_at(int axis, double coordinate) {
    const double guess = std::floor(index_of(axis, coordinate));
    auto n = static_cast<std::uint32_t>(std::clamp(guess, 0.0, static_cast<double>(size_[axis])));
    while (n > 0 && at(axis, n - 1) >= coordinate) --n;
    while (n < size_[axis] && at(axis, n) < coordinate) ++n;
    turn_[axis] = n;
}

std::optional<SampleLines::Crossing> SampleLines::crossing(const Triangle& p, std::uint32_t row,
                                                           std::uint32_t section) const {
    const Point2 q{at(1, row), at(2, section)}, nudge{inward(1, row), inward(2, section)};
    const auto rank = [&](int axis) { return std::find(by_nudge_.begin(), by_nudge_.end(), axis); };
    const bool is_row_longer = rank(1) < rank(2);
    const auto side = [&](int n) {
        const Vec3 a = p[n], b = p[(n + 1) % 3];
        return orientation({a.y, a.z}, {b.y, b.z}, q, nudge, is_row_longer);
    };
    const int turn = side(0);
    if (turn == 0 || side(1) != turn || side(2) != turn) return {};
    return Crossing{turn > 0, first_beyond(p, turn > 0, {0, q.x, q.y}, {0, nudge.x, nudge.y})};
}

/// The first sample of the line beyond the triangle. `ahead`: the normal of the triangle points along the line.
std::uint32_t SampleLines::first_beyond(const Triangle& p, bool ahead, Vec3 line, Vec3 nudge) const {
    const auto is_beyond = [&](std::uint32_t n) {
        const int side = regionmesh::orientation(p[0], p[1], p[2], {at(0, n), line.y, line.z});
        if (side != 0) return (side > 0) == ahead;
        const std::array<int, 3> normal = normal_signs(p);
        const Vec3 all{inward(0, n), nudge.y, nudge.z};
        for (int axis : by_nudge_)
            if (const int moved = normal[axis] * sign(all[axis])) return (moved > 0) == ahead;
        return false;
    };
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double x = p[0].x - (normal.y * (line.y - p[0].y) + normal.z * (line.z - p[0].z)) / normal.x;
    const double guess = std::ceil(index_of(0, x));
    auto n = static_cast<std::uint32_t>(std::isnan(guess) ? 0 : std::clamp(guess, 0.0, static_cast<double>(size_[0])));
    while (n > 0 && is_beyond(n - 1)) --n;
    while (n < size_[0] && !is_beyond(n)) ++n;
    return n;
}

}  // namespace regionmesh
