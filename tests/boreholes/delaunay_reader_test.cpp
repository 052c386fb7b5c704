#include "boreholes/delaunay_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/exact_predicates.h"
#include "formats/fake_program.h"
#include "regionmesh/error.h"
#include "support/paths.h"
#include "support/random.h"

namespace regionmesh::formats {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

using Corners = std::array<std::uint32_t, 4>;
using Points = std::vector<Vec3>;
using Tetrahedra = std::vector<Corners>;

PointTable table_of(const Points& points) {
    PointTable table;
    table.info = {.source = "points.csv", .format = "csv"};
    table.points.positions = points;
    table.points.labels.assign(points.size(), 7);
    for (std::size_t i = 0; i < points.size(); ++i) table.rows.push_back(static_cast<std::uint32_t>(2 + i));
    return table;
}

Tetrahedra tetrahedra_of(const Points& points, const std::filesystem::path& program, std::size_t piece = 1000) {
    const auto reader = open_points(table_of(points), {.delaunay = program});
    EXPECT_EQ(reader->take_points().positions, points);
    Tetrahedra all;
    std::vector<LabelledTetrahedron> some(piece);
    while (const std::size_t count = reader->next(some))
        for (std::size_t i = 0; i < count; ++i) all.push_back(some[i].corners);
    EXPECT_EQ(reader->next(some), 0U);
    return all;
}

std::string problem(const Points& points, const std::filesystem::path& program) {
    try {
        return std::to_string(tetrahedra_of(points, program).size()) + " tetrahedra";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
}

double volume(const Points& p, const Tetrahedra& tetrahedra) {
    double sum = 0;
    for (const auto& [a, b, c, d] : tetrahedra) sum += dot(cross(p[b] - p[a], p[c] - p[a]), p[d] - p[a]);
    return sum / 6;
}

std::set<std::uint32_t> first_of_equal(const Points& points) {
    std::map<std::tuple<double, double, double>, std::uint32_t> places;
    for (std::uint32_t i = 0; i < points.size(); ++i) places.try_emplace({points[i].x, points[i].y, points[i].z}, i);
    std::set<std::uint32_t> first;
    for (const auto& [place, point] : places) first.insert(point);
    return first;
}

/// What all have in common: the corners are the points, each place once; no tetrahedron is flat or turned inside out;
/// two share a triangle at most; together they are a ball, and convex.
void expect_a_filled_hull(const Points& points, const Tetrahedra& tetrahedra) {
    using Triangle = std::array<std::uint32_t, 3>;
    std::set<std::uint32_t> corners;
    std::set<std::array<std::uint32_t, 2>> edges;
    std::map<Triangle, int> triangles;
    std::map<Triangle, Triangle> outward;
    for (const auto& [a, b, c, d] : tetrahedra) {
        ASSERT_GT(exact_orientation(points[a], points[b], points[c], points[d]), 0);
        for (const Triangle t : {Triangle{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}) {
            Triangle key = t;
            std::ranges::sort(key);
            ++triangles[key];
            outward[key] = t;
            edges.insert({{key[0], key[1]}, {key[0], key[2]}, {key[1], key[2]}});
        }
        corners.insert({a, b, c, d});
    }
    EXPECT_EQ(corners, first_of_equal(points));
    EXPECT_EQ(corners.size() - edges.size() + triangles.size() - tetrahedra.size(), 1U) << "Euler characteristic";
    for (const auto& [key, count] : triangles) {
        ASSERT_LE(count, 2);
        if (count == 2) continue;
        const auto& [a, b, c] = outward[key];
        for (const Vec3 p : points) ASSERT_LE(exact_orientation(points[a], points[b], points[c], p), 0) << "not convex";
    }
}

/// The coordinates are whole and below 500, so that nothing is rounded. Below 0 where e is inside the sphere.
std::int64_t in_sphere(const std::array<Vec3, 4>& corners, Vec3 e) {
    std::array<std::array<std::int64_t, 4>, 4> m;
    for (int i = 0; i < 4; ++i) {
        const Vec3 v = corners[i] - e;
        m[i] = {std::lround(v.x), std::lround(v.y), std::lround(v.z), std::lround(dot(v, v))};
    }
    const auto minor = [&m](int r, int i, int j, int k) {
        return m[r][0] *
               (m[i][1] * (m[j][2] * m[k][3] - m[j][3] * m[k][2]) - m[i][2] * (m[j][1] * m[k][3] - m[j][3] * m[k][1]) +
                m[i][3] * (m[j][1] * m[k][2] - m[j][2] * m[k][1]));
    };
    return minor(0, 1, 2, 3) - minor(1, 0, 2, 3) + minor(2, 0, 1, 3) - minor(3, 0, 1, 2);
}

void expect_empty_spheres(const Points& points, const Tetrahedra& tetrahedra) {
    for (const auto& [a, b, c, d] : tetrahedra)
        for (const Vec3 p : points) ASSERT_GE(in_sphere({points[a], points[b], points[c], points[d]}, p), 0);
}

Points lattice(int nx, int ny, int nz, Vec3 origin = {}, Vec3 step = {1, 1, 1}) {
    Points points;
    for (int x = 0; x < nx; ++x)
        for (int y = 0; y < ny; ++y)
            for (int z = 0; z < nz; ++z)
                points.push_back({origin.x + x * step.x, origin.y + y * step.y, origin.z + z * step.z});
    return points;
}

/// With the program itself.
class Delaunay : public testing::Test {
protected:
    void SetUp() override {
        if (program_.empty()) GTEST_SKIP() << "built without regionmesh-delaunay";
    }
    Tetrahedra tetrahedra(const Points& points, std::size_t piece = 1000) const {
        return tetrahedra_of(points, program_, piece);
    }

    std::filesystem::path program_ = test::delaunay_program();
};

TEST_F(Delaunay, lattice_is_filled_exactly) {
    const Points points = lattice(5, 4, 3);
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    expect_empty_spheres(points, made);
    EXPECT_EQ(volume(points, made), 4 * 3 * 2);
}

TEST_F(Delaunay, nothing_lies_inside_a_sphere_round_a_tetrahedron) {
    test::Random random(1);
    Points points;
    for (int i = 0; i < 60; ++i) points.push_back(random.lattice_point(200));
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    expect_empty_spheres(points, made);
}

TEST_F(Delaunay, tetrahedra_depend_on_places_only) {
    Points points = lattice(4, 4, 4);
    const auto places = [&] {
        std::set<std::multiset<std::tuple<double, double, double>>> all;
        for (const Corners& corners : tetrahedra(points)) {
            std::multiset<std::tuple<double, double, double>> one;
            for (const auto p : corners) one.emplace(points[p].x, points[p].y, points[p].z);
            all.insert(one);
        }
        return all;
    };
    const auto before = places();
    test::Random random(2);
    for (std::uint32_t i = 1; i < points.size(); ++i) std::swap(points[i], points[random.below(i + 1)]);
    EXPECT_EQ(places(), before);
}

TEST_F(Delaunay, order_is_the_same_in_every_run_and_for_pieces_of_any_size) {
    test::Random random(3);
    Points points;
    for (int i = 0; i < 2000; ++i) points.push_back(random.point(1));
    const Tetrahedra made = tetrahedra(points);
    EXPECT_EQ(tetrahedra(points, 1), made);
    EXPECT_EQ(tetrahedra(points, 100000), made);
}

TEST_F(Delaunay, of_points_at_one_place_the_first_stands) {
    Points points = lattice(3, 3, 3, {-1, -1, -1});
    const Points again(points.rbegin(), points.rend());
    points.insert(points.end(), again.begin(), again.end());
    for (const Vec3 p : again) points.push_back(-p);  // with zeros of both signs
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    EXPECT_EQ(volume(points, made), 8);
}

TEST_F(Delaunay, points_on_a_sphere_lie_on_the_hull) {
    test::Random random(4);
    Points points;
    while (points.size() < 200) {
        const Vec3 p = random.point(1);
        if (length(p) > 0.1) points.push_back((1 / length(p)) * p);
    }
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    EXPECT_LT(volume(points, made), 4 * std::numbers::pi / 3);
    EXPECT_GT(volume(points, made), 0.9 * 4 * std::numbers::pi / 3);
}

TEST_F(Delaunay, points_exactly_on_one_sphere_make_no_flat_tetrahedra) {
    Points points;
    for (const Vec3 p : lattice(19, 19, 19, {-9, -9, -9}))
        if (dot(p, p) == 81) points.push_back(p);
    ASSERT_EQ(points.size(), 102U);
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    expect_empty_spheres(points, made);
}

TEST_F(Delaunay, sides_of_a_cube_are_filled) {
    Points points;
    for (const Vec3 p : lattice(6, 6, 6))
        if (std::min({p.x, p.y, p.z}) == 0 || std::max({p.x, p.y, p.z}) == 5) points.push_back(p);
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    EXPECT_EQ(volume(points, made), 125);
}

TEST_F(Delaunay, vertical_drill_holes_on_a_grid_in_metres_of_a_country_are_filled) {
    const Points points = lattice(4, 4, 30, {500000, 6200000, 100}, {25, 25, -0.2});
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    EXPECT_NEAR(volume(points, made), 75 * 75 * 5.8, 1e-6);
}

TEST_F(Delaunay, largest_and_smallest_numbers_make_tetrahedra) {
    for (const double size : {1e308, 1e150, 1e-150, 5e-324}) {
        const Points points = lattice(2, 3, 2, {}, {size, size / 2, size});
        if (size / 2 == 0) {
            EXPECT_THAT(problem(points, program_), HasSubstr("all 12 points lie in one plane")) << size;
        } else {
            expect_a_filled_hull(points, tetrahedra(points));
        }
    }
}

TEST_F(Delaunay, one_point_off_a_plane_is_enough) {
    Points points = lattice(4, 4, 1);
    points.push_back({1, 1, 1});
    const Tetrahedra made = tetrahedra(points);
    expect_a_filled_hull(points, made);
    EXPECT_DOUBLE_EQ(volume(points, made), 3);
}

TEST_F(Delaunay, points_without_tetrahedra_are_told_how_they_lie) {
    const std::string rest = "; tetrahedra need four that do not lie in one plane";
    EXPECT_EQ(problem(lattice(1, 4, 4), program_), "points.csv: all 16 points lie in one plane" + rest);
    EXPECT_EQ(problem(lattice(1, 1, 7), program_), "points.csv: all 7 points lie on one line" + rest);
    EXPECT_EQ(problem(Points(5), program_), "points.csv: all 5 points lie at one place" + rest);
    EXPECT_EQ(problem(lattice(1, 1, 3), program_), "points.csv: 3 points; tetrahedra need at least four");
    EXPECT_EQ(problem({}, program_), "points.csv: 0 points; tetrahedra need at least four");
}

TEST_F(Delaunay, what_is_not_finite_is_refused_by_the_program) {
    Points points = lattice(2, 2, 2);
    points[5].y = HUGE_VAL;
    EXPECT_THAT(problem(points, program_), HasSubstr("point 5 (from 0) is not finite"));
}

TEST_F(Delaunay, names_lead_to_rows) {
    const auto reader = open_points(table_of(lattice(2, 2, 2)), {.delaunay = program_});
    EXPECT_EQ(reader->info().source, "points.csv");
    EXPECT_EQ(reader->take_points().labels, std::vector<InputLabel>(8, 7));
    EXPECT_EQ(reader->name_of_point(3), "row 5");
    EXPECT_EQ(reader->name_of_tetrahedron(3), "tetrahedron 3");
}

/// With programs that are not what they should be.
class FakeDelaunay : public FakePrograms {
protected:
    std::string problem_with(const std::string& lines, const Points& points = lattice(2, 2, 2)) const {
        return problem(points, program(lines));
    }
    /// Announces tetrahedra and writes these bytes of them, as printf takes them.
    std::string problem_with_answer(const std::string& count, const std::string& bytes) const {
        return problem_with("cat >/dev/null; printf 'RMTETRA1\\" + count + "\\0\\0\\0\\0\\0\\0\\0" + bytes + "'");
    }
};

TEST_F(FakeDelaunay, that_fails_is_told_with_code_and_words) {
    EXPECT_THAT(problem_with("cat >/dev/null; echo oops >&2; exit 9"),
                AllOf(StartsWith("points.csv: /"), EndsWith("program failed with exit code 9 (oops); it was given 8 "
                                                            "points: leave some out, or take a larger --step")));
    EXPECT_THAT(
        problem_with("exit 1", lattice(50, 50, 50)),
        EndsWith("failed with exit code 1; it was given 125000 points: leave some out, or take a larger --step"));
    EXPECT_THAT(problem_with("cat >/dev/null; exit 6"),
                HasSubstr("program ran out of memory; it was given 8 points: leave some out, or take a larger --step"));
}

TEST_F(FakeDelaunay, that_is_killed_is_told_with_its_signal) {
    EXPECT_THAT(problem_with("cat >/dev/null; kill -9 $$"),
                HasSubstr("program was killed by signal 9 (out of memory?); "));
    EXPECT_THAT(problem_with("kill -11 $$"), HasSubstr("program was killed by signal 11; "));
}

TEST_F(FakeDelaunay, that_writes_something_else_is_refused) {
    const std::string other = "program did not write tetrahedra; is it another program?";
    EXPECT_THAT(problem_with("cat >/dev/null; echo this is no answer that makes sense"), HasSubstr(other));
    EXPECT_THAT(problem_with("exec cat", lattice(60, 60, 60)), HasSubstr(other)) << "before it has read all";
    EXPECT_THAT(problem_with("exec yes yes"), HasSubstr(other));
}

TEST_F(FakeDelaunay, that_writes_too_little_is_noticed) {
    const std::string what = "program stopped before it had written all tetrahedra";
    EXPECT_THAT(problem_with("cat >/dev/null"), HasSubstr(what));
    EXPECT_THAT(problem_with("cat >/dev/null; printf RMTETRA1"), HasSubstr(what));
    EXPECT_THAT(problem_with_answer("1", ""), HasSubstr(what));
    EXPECT_THAT(problem_with_answer("2", "\\0\\0\\0\\0\\1\\0\\0\\0\\2\\0\\0\\0\\3\\0\\0\\0\\4\\0"), HasSubstr(what));
}

TEST_F(FakeDelaunay, that_writes_too_much_is_noticed) {
    EXPECT_THAT(problem_with_answer("0", "a"), HasSubstr("program wrote more than it announced"));
    EXPECT_THAT(problem_with_answer("1", "\\0\\0\\0\\0\\1\\0\\0\\0\\2\\0\\0\\0\\3\\0\\0\\0\\4"),
                HasSubstr("wrote more"));
}

TEST_F(FakeDelaunay, that_writes_no_four_points_is_refused) {
    const std::string what = "program wrote a tetrahedron without four points";
    EXPECT_THAT(problem_with_answer("1", "\\0\\0\\0\\0\\1\\0\\0\\0\\2\\0\\0\\0\\10\\0\\0\\0"), HasSubstr(what))
        << "point 8";
    EXPECT_THAT(problem_with_answer("1", "\\0\\0\\0\\0\\1\\0\\0\\0\\2\\0\\0\\0\\1\\0\\0\\0"), HasSubstr(what));
}

TEST_F(FakeDelaunay, that_fails_after_the_last_tetrahedron_is_refused) {
    EXPECT_THAT(problem_with("cat >/dev/null; printf 'RMTETRA1\\0\\0\\0\\0\\0\\0\\0\\0'; exit 7"),
                HasSubstr("program failed after the last"));
}

TEST_F(FakeDelaunay, at_work_ends_with_the_reader) {
    const auto reader = open_points(table_of(lattice(2, 2, 2)), {.delaunay = program("exec sleep 1000")});
    EXPECT_EQ(reader->take_points().positions.size(), 8U);
}

}  // namespace
}  // namespace regionmesh::formats
