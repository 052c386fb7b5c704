#include "volume/align_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "support/random.h"
#include "support/volumes.h"
#include "volume/section_shift.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kAlignSide = 60, kAlignSections = 24;

/// Four tubes of several labels that lean by `slope`, each section moved and turned by its shift.
test::ArrayVolume tubes(double slope, const std::vector<SectionShift>& shifts) {
    std::vector<InputLabel> labels;
    for (std::uint32_t k = 0; k < kAlignSections; ++k) {
        const SectionShift& shift = shifts[k];
        const double c = std::cos(shift.angle), s = std::sin(shift.angle), mid = (kAlignSide - 1) / 2.0;
        for (std::uint32_t j = 0; j < kAlignSide; ++j)
            for (std::uint32_t i = 0; i < kAlignSide; ++i) {
                const double u = i - mid - shift.x, v = j - mid - shift.y;
                const double x = mid + c * u + s * v - slope * k, y = mid - s * u + c * v;
                InputLabel label = 0;
                for (const auto& [at_x, at_y, own] : {std::tuple{14, 18, 1}, {32, 12, 2}, {18, 42, 3}, {40, 40, 4}})
                    if (std::hypot(x - at_x, y - at_y) < 6 + own) label = own;
                labels.push_back(label);
            }
    }
    return {{kAlignSide, kAlignSide, kAlignSections}, std::move(labels)};
}

std::vector<SectionShift> random_shifts(double size, double angle, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<SectionShift> shifts;
    for (std::uint32_t n = 0; n < kAlignSections; ++n)
        shifts.push_back({random.between(-size, size), random.between(-size, size), random.between(-angle, angle)});
    return shifts;
}

/// Root mean square of what is left of shifts.
double rms(const std::vector<SectionShift>& shifts) { return summed(shifts).rms; }

TEST(AlignReader, leaves_sections_alone_that_lean_evenly) {
    test::ArrayVolume volume = tubes(0.6, std::vector<SectionShift>(kAlignSections));
    EXPECT_LT(rms(find_jitter(volume, AlignKind::kTranslate)), 0.3);
    const auto jitter = find_jitter(volume, AlignKind::kTranslate);
    AlignReader reader(std::make_unique<test::ArrayVolume>(volume), jitter);
    EXPECT_EQ(reader.moved(), 0u);
}

TEST(AlignReader, finds_known_jitter_without_its_trend) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const std::vector<SectionShift> known = random_shifts(3, 0, seed);
        test::ArrayVolume volume = tubes(0.4, known);
        const std::vector<SectionShift> found = find_jitter(volume, AlignKind::kTranslate);
        std::vector<SectionShift> steps;
        for (std::uint32_t n = 1; n < kAlignSections; ++n)
            steps.push_back({known[n].x - known[n - 1].x, known[n].y - known[n - 1].y, 0});
        const std::vector<SectionShift> wanted = without_trend(steps);
        std::vector<SectionShift> error(kAlignSections);
        for (std::uint32_t n = 0; n < kAlignSections; ++n)
            error[n] = {found[n].x - wanted[n].x, found[n].y - wanted[n].y, 0};
        EXPECT_LT(rms(error), 0.35) << seed;
        EXPECT_GT(rms(wanted), 1.2);
    }
}

TEST(AlignReader, takes_most_of_the_jitter_out) {
    test::ArrayVolume volume = tubes(0.4, random_shifts(3, 0, 7));
    const std::vector<SectionShift> jitter = find_jitter(volume, AlignKind::kTranslate);
    AlignReader reader(std::make_unique<test::ArrayVolume>(volume), jitter);
    EXPECT_GT(reader.moved(), kAlignSections / 2);
    EXPECT_GT(reader.largest(), 1.5);
    EXPECT_LT(rms(find_jitter(reader, AlignKind::kTranslate)), 0.4 * rms(jitter));
}

TEST(AlignReader, turns_sections_back) {
    test::ArrayVolume volume = tubes(0, random_shifts(1.5, 0.08, 5));
    const std::vector<SectionShift> jitter = find_jitter(volume, AlignKind::kRigid);
    const auto turned = [](const std::vector<SectionShift>& shifts) {
        double sum = 0;
        for (const SectionShift& shift : shifts) sum += shift.angle * shift.angle;
        return std::sqrt(sum / kAlignSections);
    };
    EXPECT_GT(turned(jitter), 0.03);
    AlignReader reader(std::make_unique<test::ArrayVolume>(volume), jitter);
    EXPECT_LT(turned(find_jitter(reader, AlignKind::kRigid)), 0.6 * turned(jitter));
}

TEST(EstimateShift, finds_none_where_none_is_better) {
    const std::vector<InputLabel> solid(30 * 20, 4);
    const SectionShift shift = estimate_shift(solid, solid, 30, AlignKind::kRigid);
    EXPECT_EQ(shift.x, 0);
    EXPECT_EQ(shift.y, 0);
    EXPECT_EQ(shift.angle, 0);
}

}  // namespace
}  // namespace regionmesh
