#include "judge/verdict/swept_samples.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "judge/verdict/samples.h"

namespace regionmesh {
namespace {

const Lattice kLattice{.size = {12, 10, 8}, .spacing = {0.4, 1, 2.5}, .origin = {-1, 3, 0.7}};

/// A fan round a vertex that moves from `apex` to `position`.
struct Fan {
    std::vector<LabelledTriangle> before, after;
    Vec3 apex, position;
};

Fan random_fan(std::mt19937& random, double size) {
    const auto within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const auto in_space = [&](double x, double y, double z) {
        const auto& [spacing, origin] = std::pair(kLattice.spacing, kLattice.origin);
        return Vec3{origin.x + x * spacing.x, origin.y + y * spacing.y, origin.z + z * spacing.z};
    };
    const double x = within(0, 11), y = within(0, 9), z = within(0, 7), tilt = within(-1, 1);
    const auto near_plane = [&](double along, double across) {
        return in_space(x + along, y + across, z + tilt * along + within(-0.1, 0.1));
    };
    Fan fan{{}, {}, near_plane(0, 0), near_plane(within(-size, size) / 4, within(-size, size) / 4)};
    std::vector<Vec3> rim;
    for (int n = 0; n < 6; ++n) rim.push_back(near_plane(size * std::cos(n * 1.05), size * std::sin(n * 1.05)));
    for (int n = 0; n < 6; ++n) {
        fan.before.push_back({{fan.apex, rim[n], rim[(n + 1) % 6]}, {Label{1}, Label{2}}});
        fan.after.push_back({{fan.position, rim[n], rim[(n + 1) % 6]}, {Label{1}, Label{2}}});
    }
    return fan;
}

TEST(SweptSamples, what_is_certain_is_what_the_exact_test_finds) {
    std::mt19937 random(20);
    int clear = 0, unchanged = 0, changed = 0, sure = 0;
    for (const double size : {0.3, 1.0, 3.0})
        for (int n = 0; n < 3000; ++n) {
            const Fan fan = random_fan(random, size);
            const SweptSamples swept = find_swept_samples(kLattice, fan.before, fan.position);
            const bool changes = changes_samples(kLattice, fan.before, fan.after);
            ASSERT_FALSE(swept == SweptSamples::kNone && changes) << size << " " << n;
            ASSERT_FALSE(swept == SweptSamples::kSome && !changes) << size << " " << n;
            clear += swept == SweptSamples::kNone;
            sure += swept == SweptSamples::kSome;
            unchanged += !changes;
            changed += changes;
        }
    EXPECT_GT(changed, 300);
    EXPECT_GT(clear, 0.95 * unchanged);  // or the exact test would be asked too often
    EXPECT_GT(sure, 0.9 * changed);
}

TEST(SweptSamples, a_sample_on_the_way_is_found) {
    const Vec3 sample{kLattice.origin.x + 3 * kLattice.spacing.x, kLattice.origin.y + 4 * kLattice.spacing.y,
                      kLattice.origin.z + 2 * kLattice.spacing.z};
    const auto beside = [&](double x, double y, double z) { return sample + Vec3{x, y, z}; };
    const std::array<Label, 2> labels{Label{1}, Label{2}};
    const std::vector<LabelledTriangle> face{
        {{beside(-0.1, -0.1, -0.1), beside(0.3, 0, -0.1), beside(0, 0.3, -0.1)}, labels}};
    EXPECT_NE(find_swept_samples(kLattice, face, beside(0, 0, 0.2)), SweptSamples::kNone);
    EXPECT_NE(find_swept_samples(kLattice, face, sample), SweptSamples::kNone);
    EXPECT_EQ(find_swept_samples(kLattice, face, beside(0, 0, -0.001)), SweptSamples::kNone);
    EXPECT_EQ(find_swept_samples(kLattice, face, face[0].at[1]), SweptSamples::kNone);  // it moves along itself
}

TEST(SweptSamples, caps_sweep_nothing_inside_their_side) {
    const Vec3& origin = kLattice.origin;
    const std::array<Label, 2> labels{Label{1}, kFirstExterior};
    const std::vector<LabelledTriangle> face{{{origin, origin + Vec3{2, 0, 0}, origin + Vec3{0, 3, 0}}, labels}};
    EXPECT_EQ(find_swept_samples(kLattice, face, origin + Vec3{2, 3, 0}), SweptSamples::kNone);
    EXPECT_NE(find_swept_samples(kLattice, face, origin + Vec3{2, 3, 4}), SweptSamples::kNone);
}

}  // namespace
}  // namespace regionmesh
