#include "formats/surface/cut_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string>

namespace regionmesh {
namespace {

using Corners = std::vector<std::uint32_t>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct Shape {
    std::string name;
    std::vector<std::array<double, 2>> points;
    Corners corners = {};  // none: all points in their order
    double area = 0;       // none: not known beforehand
};

Shape ring(const std::string& name, int count, auto&& radius) {
    Shape shape{name, {}};
    for (int n = 0; n < count; ++n) {
        const double turn = 2 * std::numbers::pi * n / count, r = radius(n);
        shape.points.push_back({r * std::cos(turn), r * std::sin(turn)});
    }
    return shape;
}

std::vector<Shape> shapes() {
    std::vector<Shape> shapes{
        {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}, 1},
        {"dart, with the shorter diagonal outside", {{0, 0}, {2, 1}, {0, 2}, {1.5, 1}}, {}, 0.5},
        {"square with corners on its sides", {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, {}, 4},
        {"triangle with corners on one side", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 1}}, {}, 2},
        {"letter L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, {}, 5},
        {"square with a square hole, and a bridge to it",
         {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {1, 2}, {2, 2}, {2, 1}},
         {0, 1, 2, 3, 0, 4, 5, 6, 7, 4},
         8},
    };
    Shape comb{"comb", {{20, -1}}};
    for (int n = 20; n >= 0; --n) comb.points.push_back({double(n), n % 2 == 0 ? 5.0 : 0.25});
    comb.points.push_back({0, -1});
    shapes.push_back(comb);
    Shape spiral{"spiral", {}};
    for (const double width : {1.0, 0.8})
        for (int k = 0; k <= 60; ++k) {
            const double turn = 0.3 * (width == 1.0 ? k : 60 - k), radius = width + turn / 2 / std::numbers::pi;
            spiral.points.push_back({radius * std::cos(turn), radius * std::sin(turn)});
        }
    shapes.push_back(spiral);
    shapes.push_back(ring("star", 10, [](int n) { return n % 2 == 0 ? 1 : 0.2; }));
    std::mt19937 random(7);
    for (const int count : {5, 17, 300, 1024})
        shapes.push_back(ring("random star", count, [&](int) { return 0.3 + double(random() % 1000) / 1000; }));
    shapes.push_back(ring("round, with more corners than are cut ear by ear", 1500, [](int) { return 1; }));
    return shapes;
}

double area_of(const std::vector<Vec3>& points, const Corners& corners, Vec3 normal) {
    Vec3 sum;
    for (std::size_t n = 0; n < corners.size(); ++n)
        sum += cross(points[corners[n]], points[corners[(n + 1) % corners.size()]]);
    return dot(sum, normal) / 2;
}

TEST(CutPolygon, triangles_tile_it_and_are_the_same_from_any_corner_and_either_side) {
    // In the plane of the sections, and in an oblique one that each axis sees from another side.
    const std::array<std::array<Vec3, 2>, 2> planes{
        {{Vec3{1, 0, 0}, Vec3{0, 1, 0}}, {Vec3{-2. / 3, 1. / 3, 2. / 3}, Vec3{2. / 3, 2. / 3, 1. / 3}}}};
    for (const auto& [u, v] : planes) {
        for (const Shape& shape : shapes()) {
            std::vector<Vec3> points;
            for (const auto& [x, y] : shape.points) points.push_back(x * u + y * v);
            Corners corners = shape.corners;
            if (corners.empty()) {
                corners.resize(points.size());
                std::iota(corners.begin(), corners.end(), 0u);
            }
            const Vec3 normal = cross(u, v);
            const double area = area_of(points, corners, normal);
            if (shape.area > 0) {
                EXPECT_NEAR(area, shape.area, 1e-12) << shape.name;
            }
            std::set<std::set<std::uint32_t>> expected;
            for (const bool is_turned : {false, true}) {
                for (std::size_t first = 0; first < corners.size(); first += 1 + corners.size() / 12) {
                    Corners turned = corners;
                    std::ranges::rotate(turned, turned.begin() + static_cast<std::ptrdiff_t>(first));
                    if (is_turned) std::ranges::reverse(turned);
                    Triangles triangles;
                    cut_polygon(points, turned, triangles);
                    ASSERT_EQ(triangles.size(), corners.size() - 2) << shape.name;
                    double sum = 0;
                    std::set<std::set<std::uint32_t>> found;
                    for (const auto& [a, b, c] : triangles) {
                        const double part = area_of(points, {a, b, c}, is_turned ? -1 * normal : normal);
                        EXPECT_GT(part, 0) << shape.name << ' ' << a << ' ' << b << ' ' << c;
                        sum += part;
                        found.insert({a, b, c});
                    }
                    EXPECT_NEAR(sum, area, 1e-12 * area) << shape.name;
                    if (expected.empty()) expected = found;
                    EXPECT_EQ(found, expected) << shape.name << ", from corner " << first;
                }
            }
        }
    }
}

TEST(CutPolygon, convex_quads_are_cut_along_the_shorter_diagonal) {
    const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {4, 2, 0}, {1, 2, 0}};
    Triangles triangles;
    cut_polygon(points, Corners{0, 1, 2, 3}, triangles);
    for (const auto& triangle : triangles) {
        EXPECT_EQ(std::ranges::count(triangle, 1u), 1);
        EXPECT_EQ(std::ranges::count(triangle, 3u), 1);
    }
}

TEST(CutPolygon, rounded_corners_on_straight_sides_make_no_needles) {
    for (int n = 0; n < 50; ++n) {
        const double turn = 0.1 + 0.025 * n;
        const Vec3 u{std::cos(turn), std::sin(turn), 0.3}, v{-std::sin(turn), std::cos(turn), 0.2};
        std::vector<Vec3> points;
        for (const auto& [x, y] : {std::array{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {1, 3}, {0, 3}, {0, 1}}) {
            const Vec3 p = double(x) * u + double(y) * v;
            points.push_back({float(p.x), float(p.y), float(p.z)});
        }
        Triangles triangles;
        cut_polygon(points, Corners{0, 1, 2, 3, 4, 5, 6, 7, 8}, triangles);
        for (const auto& [a, b, c] : triangles)
            EXPECT_GT(length(cross(points[b] - points[a], points[c] - points[a])), 0.1) << turn;
    }
}

TEST(CutPolygon, polygons_that_are_none_become_as_many_triangles) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 0}, {3, 3, 0}};
    for (const Corners& corners : {Corners{0, 1, 2, 3}, Corners{0, 1, 4, 5}, Corners{0, 0, 0, 0},
                                   Corners{0, 1, 0, 1, 0}, Corners{0, 1, 2, 3, 4, 5}}) {
        Triangles triangles;
        cut_polygon(points, corners, triangles);
        EXPECT_EQ(triangles.size(), corners.size() - 2);
    }
}

}  // namespace
}  // namespace regionmesh
