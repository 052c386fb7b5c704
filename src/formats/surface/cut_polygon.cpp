#include "formats/surface/cut_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace regionmesh {
namespace {

/// Corners of the largest polygon that is cut ear by ear. The work grows with the square of their number.
constexpr std::size_t kMostForEars = 1024;

/// The corners of a polygon from the lowest point on, towards the lower of its neighbours. So the order depends neither
/// on the corner that a file begins with, nor on the side that the polygon is seen from.
class CornersInOrder {
public:
    CornersInOrder(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners)
        : points_(points), corners_(corners) {
        const auto place = [&](std::size_t n) {
            const Vec3 p = points[corners[n % corners.size()]];
            return std::tuple(p.x, p.y, p.z);
        };
        const auto before = [&](std::size_t n) { return place(n + corners.size() - 1); };
        const auto neighbours = [&](std::size_t n) { return std::minmax({before(n), place(n + 1)}); };
        // A polygon with a hole may pass its lowest point twice.
        for (std::size_t n = 1; n < corners.size(); ++n)
            if (place(n) < place(first_) || (place(n) == place(first_) && neighbours(n) < neighbours(first_)))
                first_ = n;
        is_reversed_ = before(first_) < place(first_ + 1);
    }
    std::size_t size() const { return corners_.size(); }
    std::uint32_t operator[](std::size_t n) const {
        return corners_[(first_ + (is_reversed_ ? corners_.size() - n : n)) % corners_.size()];
    }
    Vec3 point(std::size_t n) const { return points_[(*this)[n]]; }
    /// A triangle of these corners, on the side of the polygon.
    std::array<std::uint32_t, 3> triangle(std::size_t a, std::size_t b, std::size_t c) const {
        if (is_reversed_) std::swap(b, c);
        return {(*this)[a], (*this)[b], (*this)[c]};
    }

private:
    const std::vector<Vec3>& points_;
    std::span<const std::uint32_t> corners_;
    std::size_t first_ = 0;
    bool is_reversed_;
};

/// Twice the area vector of the polygon (Newell's method).
Vec3 area_vector(const CornersInOrder& corners) {
    Vec3 sum;
    const Vec3 origin = corners.point(0);
    for (std::size_t n = 2; n < corners.size(); ++n)
        sum += cross(corners.point(n - 1) - origin, corners.point(n) - origin);
    return sum;
}

/// Cuts off ears: a corner is an ear if it is convex, and no other corner lies in the triangle that it makes with its
/// neighbours. Every simple polygon of four or more corners has two (Meisters 1975). Seen along the axis on which its
/// area is largest, where coordinates are not rounded.
class EarCutter {
public:
    explicit EarCutter(const CornersInOrder& corners) : corners_(corners) {
        const Vec3 area = area_vector(corners);
        int axis = 0;
        for (const int other : {1, 2})
            if (std::abs(area[other]) > std::abs(area[axis])) axis = other;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (std::size_t n = 0; n < corners.size(); ++n) {
            const Vec3 p = corners.point(n);
            places_.push_back(area[axis] < 0 ? Place{p[v], p[u]} : Place{p[u], p[v]});
            links_.push_back({n == 0 ? corners.size() - 1 : n - 1, n + 1 == corners.size() ? 0 : n + 1});
        }
        for (std::size_t n = 0; n < corners.size(); ++n)
            if (turn(links_[n].before, n, links_[n].after) <= 0) not_convex_.push_back(n);
        for (std::size_t n = 0; n < corners.size(); ++n) cuts_.push_back(cut_of(n));
    }

    /// Calls add(a, b, c) for each ear b, and returns the corners that are left: three, or more of a polygon that
    /// crosses itself or has no area.
    template <class Add>
    std::vector<std::size_t> cut(Add&& add) {
        std::vector<std::size_t> left;
        for (std::size_t n = 1; n < cuts_.size(); ++n) left.push_back(n);
        left.push_back(0);  // last, so that of two equal diagonals of a quad the one at corner 0 is taken
        while (left.size() > 3) {
            const auto ear = std::ranges::min_element(left, {}, [&](std::size_t n) { return cuts_[n]; });
            if (cuts_[*ear] == kNoEar) break;
            const auto [before, after] = links_[*ear];
            add(before, *ear, after);
            left.erase(ear);
            links_[before].after = after;
            links_[after].before = before;
            cuts_[before] = cut_of(before);
            cuts_[after] = cut_of(after);
        }
        std::ranges::sort(left);
        return left;
    }

private:
    struct Place {
        double u, v;
        friend bool operator==(const Place&, const Place&) = default;
    };
    struct Link {
        std::size_t before, after;
    };
    static constexpr double kNoEar = std::numeric_limits<double>::infinity();
    static constexpr double kNeedle = 1e-4;  // of the length of the cut: more than rounding to single precision leaves

    /// Positive where the path a b c turns to the left.
    double turn(std::size_t a, std::size_t b, std::size_t c) const {
        const Place &p = places_[a], &q = places_[b], &r = places_[c];
        return (q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u);
    }

    /// Squared length of the edge that cuts off corner n, and far more for a needle: a corner on a straight side, which
    /// is convex by rounding alone, goes last.
    double cut_of(std::size_t n) const {
        const auto [a, c] = links_[n];
        const double twice_area = turn(a, n, c);
        if (!(twice_area > 0)) return kNoEar;
        for (const std::size_t other : not_convex_) {
            const Place& p = places_[other];
            if (p == places_[a] || p == places_[n] || p == places_[c]) continue;
            if (turn(a, n, other) >= 0 && turn(n, c, other) >= 0 && turn(c, a, other) >= 0) return kNoEar;
        }
        const double cut = length2(corners_.point(a) - corners_.point(c));
        return twice_area < kNeedle * cut ? cut * 1e12 : cut;
    }

    const CornersInOrder& corners_;
    std::vector<Place> places_;            // by corner
    std::vector<Link> links_;              // by corner, among those that are left
    std::vector<std::size_t> not_convex_;  // corners of the whole polygon: no others can lie in an ear
    std::vector<double> cuts_;             // by corner; kNoEar where it is none
};

/// Triangles of the polygon from corner `first` to corner `last`: one to the middle, then the two halves. No vertex has
/// more faces than twice the logarithm of the number of corners.
template <class Add>
void cut_in_halves(std::size_t first, std::size_t last, Add&& add) {
    if (last - first < 2) return;
    const std::size_t middle = first + (last - first) / 2;
    add(first, middle, last);
    cut_in_halves(first, middle, add);
    cut_in_halves(middle, last, add);
}

}  // namespace

void cut_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    const CornersInOrder ordered(points, corners);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.push_back(ordered.triangle(a, b, c));
    };
    if (corners.size() > kMostForEars) return cut_in_halves(0, corners.size() - 1, add);
    const std::vector<std::size_t> left = EarCutter(ordered).cut(add);
    cut_in_halves(0, left.size() - 1,
                  [&](std::size_t a, std::size_t b, std::size_t c) { add(left[a], left[b], left[c]); });
}

}  // namespace regionmesh
