#include "check/quality_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/triangle.h"
#include "support/random.h"

namespace regionmesh {
namespace {

using Corners = std::array<Vec3, 3>;

double angle_at(const Corners& p, int n) {
    const Vec3 s = p[(n + 1) % 3] - p[n], t = p[(n + 2) % 3] - p[n];
    return std::atan2(length(cross(s, t)), dot(s, t)) * 180 / std::numbers::pi;
}

/// In the second lane, beside a face of another shape.
void add(QualitySum& sum, const Corners& p) {
    const Corners other{Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 1, 0}};
    sum.add(TwoFaces({side_by_side(other[0], p[0]), side_by_side(other[1], p[1]), side_by_side(other[2], p[2])}), 1);
}

QualityReport report_of(const std::vector<Corners>& faces) {
    QualitySum sum;
    for (const Corners& p : faces) add(sum, p);
    return sum.report();
}

TEST(QualitySum, puts_each_angle_into_its_bin) {
    test::Random random(1);
    SCOPED_TRACE("seed 1");
    std::vector<Corners> faces;
    for (int n = 0; n < 5000; ++n) {
        const Vec3 a = random.point(1), b = random.point(1);
        const double flat = n % 3 == 0 ? 1e-9 : n % 3 == 1 ? 1e-3 : 1;  // slivers, too
        faces.push_back({a, b, a + random.between(-1, 2) * (b - a) + flat * random.point(1)});
    }
    const QualityReport report = report_of(faces);
    std::array<std::uint64_t, 18> bins{};
    double least = 180, most = 0, quality = 1;
    for (const Corners& p : faces) {
        for (int n = 0; n < 3; ++n) {
            least = std::min(least, angle_at(p, n));
            most = std::max(most, angle_at(p, n));
            ++bins[std::clamp(int(angle_at(p, n) / 10), 0, 17)];
        }
        quality = std::min(quality, face_quality(p[0], p[1], p[2]));
    }
    EXPECT_EQ(report.angle_histogram, bins);
    EXPECT_NEAR(report.min_angle, least, 1e-9 * least);
    EXPECT_NEAR(report.max_angle, most, 1e-9);
    EXPECT_EQ(report.min, quality);
}

TEST(QualitySum, knows_right_angles_and_half_of_them) {
    const QualityReport report = report_of({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}});
    EXPECT_EQ(report.angle_histogram[9], 1u) << "90 belongs to the bin from 90 on";
    EXPECT_EQ(report.angle_histogram[4], 2u);
    EXPECT_EQ(report.max_angle, 90);
    EXPECT_EQ(report.min_angle, 45);
}

TEST(QualitySum, bins_begin_where_they_should) {
    for (int bin = 1; bin < 18; ++bin) {
        for (double off : {-1e-7, 1e-7}) {
            const double angle = (bin * 10 + off) * std::numbers::pi / 180;
            const QualityReport report =
                report_of({{Vec3{}, Vec3{1, 0, 0}, Vec3{std::cos(angle), std::sin(angle), 0}}});
            EXPECT_GE(report.angle_histogram[off < 0 ? bin - 1 : bin], 1u) << bin * 10 << " degrees " << off;
        }
    }
}

TEST(QualitySum, takes_faces_without_area) {
    const QualityReport report = report_of({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}}, {Vec3{}, Vec3{}, Vec3{}}});
    EXPECT_EQ(report.min_angle, 0);
    EXPECT_EQ(report.max_angle, 180);
    EXPECT_EQ(report.min, 0);
    EXPECT_EQ(report_of({}).max_angle, 0);
}

TEST(QualitySum, of_two_parts_is_that_of_the_whole) {
    test::Random random(2);
    QualitySum whole, first, second;
    for (int n = 0; n < 100; ++n) {
        const Corners p{random.point(1), random.point(1), random.point(1)};
        add(whole, p);
        add(n < 40 ? first : second, p);
    }
    first.append(QualitySum());
    first.append(second);
    const QualityReport a = whole.report(), b = first.report();
    EXPECT_EQ(a.min, b.min);
    EXPECT_EQ(a.min_angle, b.min_angle);
    EXPECT_EQ(a.max_angle, b.max_angle);
    EXPECT_EQ(a.histogram, b.histogram);
    EXPECT_EQ(a.angle_histogram, b.angle_histogram);
    EXPECT_NEAR(a.mean, b.mean, 1e-15);
}

}  // namespace
}  // namespace regionmesh
