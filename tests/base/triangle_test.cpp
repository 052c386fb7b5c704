#include "base/triangle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regionmesh {
namespace {

TEST(FaceQuality, has_the_three_values_of_equation_3) {
    EXPECT_NEAR(face_quality({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 0.26, 0.005);
    EXPECT_NEAR(face_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 0.24, 0.005);
    const double half = std::sqrt(0.5);
    EXPECT_NEAR(face_quality({0, 0, 0}, {1, 0, 0}, {-half, half, 0}), 0.16, 0.005) << "isosceles with 135 degrees";
}

TEST(FaceQuality, does_not_depend_on_scale_place_or_order) {
    const Vec3 a{0, 0, 0}, b{3, 1, 0}, c{1, 2, 2}, far{1e3, -1e3, 1e3};
    const double quality = face_quality(a, b, c);
    EXPECT_NEAR(face_quality(b, c, a), quality, 1e-12);
    EXPECT_NEAR(face_quality(c, b, a), quality, 1e-12);
    EXPECT_NEAR(face_quality(1e6 * a, 1e6 * b, 1e6 * c), quality, 1e-12);
    EXPECT_NEAR(face_quality(a + far, b + far, c + far), quality, 1e-9);
}

TEST(FaceQuality, of_a_degenerate_face_is_0) {
    EXPECT_EQ(face_quality({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), 0);
    EXPECT_EQ(face_quality({1, 2, 3}, {1, 2, 3}, {1, 2, 3}), 0);
}

TEST(QualityTerms, comparison_without_roots_agrees_with_the_value) {
    for (double height = 0.01; height < 3; height *= 1.3) {
        const QualityTerms terms = quality_terms({0, 0, 0}, {1, 0, 0}, {0.2, height, 0});
        for (double bound : {0.05, 0.1, 0.15, 0.2, 0.25}) EXPECT_EQ(terms.is_at_least(bound), terms.value() >= bound);
    }
}

TEST(FaceQuality, that_is_surely_above_a_bound_is_above_it) {
    int sure = 0, above = 0;
    for (double along = -2; along < 3; along += 0.1)
        for (double height = 1e-3; height < 30; height *= 1.1)
            for (double bound : {0.02, 0.1, 0.2, 0.25}) {
                const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{along, height, 0};
                const bool is_above = face_quality(a, b, c) > bound;
                if (quality_is_surely_above(bound, a, b, c)) {
                    EXPECT_TRUE(is_above) << along << ' ' << height << ' ' << bound;
                    ++sure;
                }
                above += is_above;
            }
    EXPECT_GT(sure, 0.7 * above);
    EXPECT_FALSE(quality_is_surely_above(0.1, {0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
    EXPECT_FALSE(quality_is_surely_above(0.1, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}));
}

TEST(AreaVector, is_twice_the_area_along_the_normal) {
    EXPECT_EQ(area_vector({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), (Vec3{0, 0, 6}));
}

}  // namespace
}  // namespace regionmesh
