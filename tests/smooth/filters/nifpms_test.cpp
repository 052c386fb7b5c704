#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/hash.h"
#include "mesh/strata.h"
#include "regionmesh/smooth.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

constexpr SmoothOptions kNifpms{.filter = SmoothFilter::kNifpms, .threads = 1};

double random_height(std::uint32_t n) { return 2 * hash_unit(n, 77) - 1; }

/// A sheet of side x side squares in the plane through the origin along u and v, raised where `height` says so.
template <class Height>
Mesh sheet(std::uint32_t side, Vec3 u, Vec3 v, Height&& height) {
    Mesh mesh;
    const Vec3 up = cross(u, v);
    for (std::uint32_t j = 0; j <= side; ++j)
        for (std::uint32_t i = 0; i <= side; ++i) mesh.add_vertex(double(i) * u + double(j) * v + height(i, j) * up);
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
            mesh.add_face(VertexId{a}, VertexId{b}, VertexId{d}, 0, 1);
            mesh.add_face(VertexId{a}, VertexId{d}, VertexId{c}, 0, 1);
        }
    return mesh;
}

/// Root of the mean square height of the vertices four squares and more from the rim.
double rms_height(const Mesh& mesh, std::uint32_t side) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t j = 4; j + 4 <= side; ++j)
        for (std::uint32_t i = 4; i + 4 <= side; ++i) {
            const double z = mesh.position(VertexId{j * (side + 1) + i}).z;
            sum += z * z;
            ++count;
        }
    return std::sqrt(sum / count);
}

/// The surface of a cube with so many squares along each edge, region 0 inside 1.
Mesh cube(int side) {
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    std::vector<Vec3> positions;
    std::vector<test::ShapeFace> faces;
    const auto number = [&](std::array<int, 3> at) {
        const auto [found, is_new] = numbers.emplace(at, static_cast<std::uint32_t>(positions.size()));
        if (is_new) positions.push_back({double(at[0]), double(at[1]), double(at[2])});
        return found->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int end : {0, side})
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    const auto at = [&](int du, int dv) {
                        std::array<int, 3> p{};
                        p[axis] = end;
                        p[(axis + 1) % 3] = i + du;
                        p[(axis + 2) % 3] = j + dv;
                        return number(p);
                    };
                    std::array<std::uint32_t, 4> q{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
                    if (end == 0) std::swap(q[1], q[3]);
                    faces.push_back({{q[0], q[1], q[2]}});
                    faces.push_back({{q[0], q[2], q[3]}});
                }
    return test::shape(positions, faces);
}

/// Farthest that a vertex on an edge of the cube went.
double edge_displacement(int side, const SmoothOptions& options) {
    const Mesh before = cube(side);
    Mesh mesh = cube(side);
    smooth(mesh, options);
    test::expect_sound(check(mesh));
    double most = 0;
    test::for_vertices(mesh, [&](VertexId v) {
        const Vec3 p = before.position(v);
        int ends = 0;
        for (int axis = 0; axis < 3; ++axis) ends += p[axis] == 0 || p[axis] == side;
        if (ends >= 2) most = std::max(most, length(mesh.position(v) - p));
    });
    return most;
}

TEST(Nifpms, a_noisy_plane_becomes_flatter) {
    constexpr std::uint32_t kSide = 20;
    Mesh mesh = sheet(kSide, {1, 0, 0}, {0, 1, 0}, [&](auto i, auto j) { return 0.15 * random_height(100 * i + j); });
    const double before = rms_height(mesh, kSide);
    const SmoothReport report = smooth(mesh, kNifpms);
    EXPECT_LT(rms_height(mesh, kSide), 0.5 * before);
    EXPECT_GT(report.largest_displacement, 0.05);
}

TEST(Nifpms, planes_are_fixed_points) {
    const double s = std::sqrt(0.5);
    for (const auto& [u, v] : {std::pair{Vec3{1, 0, 0}, Vec3{0, 1, 0}},
                               {Vec3{s, s, 0}, Vec3{0, 0, 1}},
                               {Vec3{0.6, 0, 0.8}, Vec3{0, 1, 0}}}) {
        const auto flat = [](auto, auto) { return 0.0; };
        const Mesh before = sheet(8, u, v, flat);
        Mesh mesh = sheet(8, u, v, flat);
        smooth(mesh, kNifpms);
        test::for_vertices(mesh, [&](VertexId w) { EXPECT_LT(length(mesh.position(w) - before.position(w)), 1e-12); });
    }
}

TEST(Nifpms, the_edges_of_a_cube_stay_sharper_than_with_taubin) {
    const double kept = edge_displacement(10, kNifpms), taubin = edge_displacement(10, {.threads = 1});
    const double laplacian = edge_displacement(10, {.filter = SmoothFilter::kLaplacian, .threads = 1});
    EXPECT_LT(kept, 0.8 * taubin);
    EXPECT_LT(kept, 0.3 * laplacian);
}

TEST(Nifpms, faces_of_a_cube_stay_flat) {
    constexpr int kSide = 12;
    const Mesh before = cube(kSide);
    Mesh mesh = cube(kSide);
    smooth(mesh, kNifpms);
    test::for_vertices(mesh, [&](VertexId v) {
        const Vec3 p = before.position(v);
        if (p.x == 0 && std::min({p.y, p.z, kSide - p.y, kSide - p.z}) >= 4) {
            EXPECT_NEAR(mesh.position(v).x, 0, 0.1);
        }
    });
}

/// Three pages that meet in a line along x; the line swings out of it, the rims do not.
Mesh book(std::uint32_t length, double swing) {
    Mesh mesh;
    const std::array<Vec3, 3> pages{Vec3{0, 1, 0}, Vec3{0, -0.5, std::sqrt(0.75)}, Vec3{0, -0.5, -std::sqrt(0.75)}};
    for (std::uint32_t i = 0; i <= length; ++i)
        mesh.add_vertex({double(i), swing * random_height(i), swing * random_height(1000 + i)});
    for (Label page = 0; page < 3; ++page) {
        std::uint32_t near = 0;
        for (int ring = 1; ring <= 3; ++ring) {
            const std::uint32_t far = mesh.vertex_end();
            for (std::uint32_t i = 0; i <= length; ++i)
                mesh.add_vertex(Vec3{double(i), 0, 0} + double(ring) * pages[page]);
            for (std::uint32_t i = 0; i < length; ++i) {
                const VertexId a{near + i}, b{near + i + 1}, c{far + i}, d{far + i + 1};
                mesh.add_face(a, b, d, page, (page + 1) % 3);
                mesh.add_face(a, d, c, page, (page + 1) % 3);
            }
            near = far;
        }
    }
    return mesh;
}

TEST(Nifpms, lines_are_smoothed_along_themselves) {
    constexpr std::uint32_t kLength = 30;
    Mesh mesh = book(kLength, 0.2);
    ASSERT_EQ(vertex_labels(mesh, VertexId{10}).size(), 3);
    const auto rms = [&] {
        double sum = 0;
        for (std::uint32_t i = 4; i + 4 <= kLength; ++i)
            sum += std::pow(mesh.position(VertexId{i}).y, 2) + std::pow(mesh.position(VertexId{i}).z, 2);
        return std::sqrt(sum);
    };
    const double before = rms();
    smooth(mesh, kNifpms);
    EXPECT_LT(rms(), 0.75 * before);
    for (std::uint32_t end : {0u, kLength})
        EXPECT_EQ(mesh.position(VertexId{end}), book(kLength, 0.2).position(VertexId{end})) << "the rim stays";
}

TEST(Nifpms, a_straight_line_stays_where_it_is) {
    const Mesh before = book(12, 0);
    Mesh mesh = book(12, 0);
    smooth(mesh, kNifpms);
    test::for_vertices(mesh, [&](VertexId v) { EXPECT_LT(length(mesh.position(v) - before.position(v)), 1e-12); });
}

TEST(Nifpms, quadruple_points_and_corners_of_the_box_stay) {
    const Mesh before = test::run(test::noise_volume({7, 7, 7}, 4, 3)).mesh;
    Mesh mesh = test::run(test::noise_volume({7, 7, 7}, 4, 3)).mesh;
    smooth(mesh, kNifpms);
    test::for_vertices(mesh, [&](VertexId v) {
        if (vertex_labels(mesh, v).size() > 3) {
            EXPECT_EQ(mesh.position(v), before.position(v));
        }
    });
    test::expect_sound(check(mesh));
}

TEST(Nifpms, smooths_the_steps_of_a_ball) {
    constexpr Vec3 kMiddle{7.5, 7.5, 7.5};
    const auto roughness = [&](const Mesh& mesh) {
        double sum = 0, square = 0;
        int count = 0;
        test::for_vertices(mesh, [&](VertexId v) {
            const double radius = length(mesh.position(v) - kMiddle);
            sum += radius;
            square += radius * radius;
            ++count;
        });
        return std::sqrt(square / count - (sum / count) * (sum / count));
    };
    ReconstructOptions options = test::plain();
    options.background = {0};
    Mesh mesh = test::run(test::ball_volume({16, 16, 16}, 5), options).mesh;
    const double before = roughness(mesh);
    smooth(mesh, kNifpms);
    EXPECT_LT(roughness(mesh), 0.65 * before);
    test::expect_sound(check(mesh));
}

TEST(Nifpms, follows_the_scale) {
    constexpr std::uint32_t kSide = 10;
    const auto noise = [](auto i, auto j) { return 0.15 * random_height(100 * i + j); };
    Mesh small = sheet(kSide, {1, 0, 0}, {0, 1, 0}, noise);
    Mesh large = sheet(kSide, {1024, 0, 0}, {0, 1024, 0}, [&](auto i, auto j) { return noise(i, j) / 1024; });
    smooth(small, kNifpms);
    smooth(large, {.filter = SmoothFilter::kNifpms, .scale = 1024, .threads = 1});
    test::for_vertices(small,
                       [&](VertexId v) { EXPECT_LT(length(1024 * small.position(v) - large.position(v)), 1e-6); });
}

}  // namespace
}  // namespace regionmesh
