#include "volume/between_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "regionmesh/error.h"
#include "regionmesh/prepare_sections.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

using Shape = std::function<InputLabel(double x, double y, double z)>;
constexpr std::uint32_t kSide = 40;

/// Samples of a shape, `far` apart along z.
test::ArrayVolume sampled(const Shape& shape, std::uint32_t sections, double far) {
    std::vector<InputLabel> labels;
    for (std::uint32_t k = 0; k < sections; ++k)
        for (std::uint32_t j = 0; j < kSide; ++j)
            for (std::uint32_t i = 0; i < kSide; ++i) labels.push_back(shape(i, j, k * far));
    test::ArrayVolume volume({kSide, kSide, sections}, std::move(labels));
    volume.spaced({1, 1, far});
    return volume;
}

std::vector<InputLabel> all_of(SectionReader& reader) {
    std::vector<InputLabel> all, section(std::size_t{reader.section_width()} * reader.section_height());
    while (reader.next(section)) all.insert(all.end(), section.begin(), section.end());
    return all;
}

std::vector<InputLabel> filled(const test::ArrayVolume& volume, std::uint32_t between, std::uint32_t threads = 1) {
    BetweenReader reader(std::make_unique<test::ArrayVolume>(volume), between, threads);
    return all_of(reader);
}

/// Share of the samples that another volume has otherwise.
double share_of_others(const std::vector<InputLabel>& a, const std::vector<InputLabel>& b) {
    EXPECT_EQ(a.size(), b.size());
    double others = 0;
    for (std::size_t n = 0; n < a.size(); ++n) others += a[n] != b[n];
    return others / static_cast<double>(a.size());
}

struct Parts {
    std::size_t all = 0, inside = 0;  // inside: in neither the first section nor the last
};

/// Parts of a label, connected as in the mesh: over the edges of Kuhn's tetrahedra.
Parts parts_of(const std::vector<InputLabel>& labels, int width, int height, InputLabel label) {
    const int area = width * height, depth = static_cast<int>(labels.size()) / area;
    std::vector<bool> seen(labels.size());
    Parts parts;
    for (std::size_t first = 0; first < labels.size(); ++first) {
        if (seen[first] || labels[first] != label) continue;
        bool is_inside = true;
        std::vector<int> open{static_cast<int>(first)};
        seen[first] = true;
        while (!open.empty()) {
            const int n = open.back(), x = n % width, y = n / width % height, z = n / area;
            open.pop_back();
            is_inside &= z > 0 && z + 1 < depth;
            for (int step = 1; step < 8; ++step)
                for (const int sign : {-1, 1}) {
                    const int u = x + sign * (step & 1), v = y + sign * (step >> 1 & 1), w = z + sign * (step >> 2);
                    if (u < 0 || v < 0 || w < 0 || u >= width || v >= height || w >= depth) continue;
                    const int other = (w * height + v) * width + u;
                    if (seen[other] || labels[other] != label) continue;
                    seen[other] = true;
                    open.push_back(other);
                }
        }
        ++parts.all;
        parts.inside += is_inside;
    }
    return parts;
}

/// A tube that moves by 1.5 along x for each step along z.
InputLabel tube(double x, double y, double z) { return std::hypot(x - 6 - 1.5 * z, y - 20) < 3.2; }

/// One tube that parts in two.
InputLabel branch(double x, double y, double z) {
    const double away = std::max(0.0, z - 6);
    return std::hypot(x - 20 - away, y - 20) < 3.5 || std::hypot(x - 20 + away, y - 20) < 3.5;
}

/// A plate three samples thick at 45 degrees, which overlaps nothing from section to section.
InputLabel plate(double x, double, double z) { return std::abs(x - 8 - z) < 1.6; }

InputLabel helix(double x, double y, double z) {
    return std::hypot(x - 20 - 10 * std::cos(z / 5), y - 20 - 10 * std::sin(z / 5)) < 3.2;
}

TEST(BetweenReader, keeps_every_section_of_the_volume) {
    const test::ArrayVolume volume = test::noise_volume({9, 7, 5}, 4, 3);
    const std::vector<InputLabel> labels = filled(volume, 3);
    ASSERT_EQ(labels.size(), 63u * 17);
    for (std::size_t n = 0; n < volume.labels().size(); ++n)
        EXPECT_EQ(labels[n / 63 * 4 * 63 + n % 63], volume.labels()[n]);
}

TEST(BetweenReader, has_the_lattice_of_the_sections_between) {
    auto volume = std::make_unique<test::ArrayVolume>(test::noise_volume({9, 7, 5}, 4, 3));
    volume->spaced({2, 2, 8});
    const BetweenReader reader(std::move(volume), 3, 1);
    EXPECT_EQ(reader.info().lattice.size, (std::array<std::uint32_t, 3>{9, 7, 17}));
    EXPECT_EQ(reader.info().lattice.spacing.z, 2);
    EXPECT_EQ(reader.info().can_sweep, (std::array<bool, 3>{false, false, true}));
}

TEST(BetweenReader, puts_the_same_section_between_two_that_are_the_same) {
    const test::ArrayVolume one = test::grain_volume({20, 20, 1}, 9, 5);
    std::vector<InputLabel> two = one.labels();
    two.insert(two.end(), one.labels().begin(), one.labels().end());
    const std::vector<InputLabel> labels = filled({{20, 20, 2}, two}, 2);
    for (std::size_t n = 0; n < labels.size(); ++n) EXPECT_EQ(labels[n], one.labels()[n % 400]);
}

TEST(BetweenReader, gives_the_same_again_and_with_more_threads) {
    const test::ArrayVolume volume = test::grain_volume({150, 130, 4}, 60, 11);
    BetweenReader reader(std::make_unique<test::ArrayVolume>(volume), 2, 1);
    const std::vector<InputLabel> first = all_of(reader);
    reader.rewind();
    EXPECT_EQ(all_of(reader), first);
    EXPECT_EQ(filled(volume, 2, 3), first);
}

TEST(BetweenReader, follows_parts_that_do_not_overlap) {
    for (const auto& [shape, sections, far, most] :
         {std::tuple{Shape(tube), 4u, 6.0, 0.004}, {Shape(plate), 5u, 6.0, 0.015}, {Shape(helix), 6u, 6.0, 0.014}}) {
        const std::uint32_t steps = 6, fine_sections = (sections - 1) * steps + 1;
        const std::vector<InputLabel> labels = filled(sampled(shape, sections, far), steps - 1);
        const std::vector<InputLabel> fine = sampled(shape, fine_sections, 1).labels();
        EXPECT_LT(share_of_others(labels, fine), most);
        EXPECT_EQ(parts_of(labels, kSide, kSide, 1).all, 1u);
    }
}

TEST(BetweenReader, keeps_a_branching_tube_in_one_part) {
    const std::vector<InputLabel> labels = filled(sampled(branch, 4, 5), 4);
    EXPECT_EQ(parts_of(labels, kSide, kSide, 1).all, 1u);
    EXPECT_EQ(parts_of(labels, kSide, kSide, 0).all, 1u);
    EXPECT_LT(share_of_others(labels, sampled(branch, 16, 1).labels()), 0.02);
}

TEST(BetweenReader, ends_a_part_halfway) {
    const auto cylinder = [](double x, double y, double z) -> InputLabel {
        return z < 9 && std::hypot(x - 20, y - 20) < 6;
    };
    const std::vector<InputLabel> labels = filled(sampled(cylinder, 3, 8), 7);
    const auto at_axis = [&](std::uint32_t section) { return labels[(section * kSide + 20) * kSide + 20]; };
    for (std::uint32_t n = 0; n <= 16; ++n) EXPECT_EQ(at_axis(n), n < 12 ? 1 : 0) << n;
}

/// No part of a label lies between two sections alone.
TEST(BetweenReader, makes_no_part_that_no_section_shows) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const test::ArrayVolume volume = test::noise_volume({14, 12, 2}, 3, seed);
        const std::vector<InputLabel> labels = filled(volume, 4);
        for (const InputLabel label : {0, 1, 2}) EXPECT_EQ(parts_of(labels, 14, 12, label).inside, 0u) << seed;
    }
}

TEST(PrepareSections, acts_by_itself_where_parts_do_not_overlap_and_sections_are_far) {
    const auto prepared = [](const Shape& shape, double far, PrepareOptions options) {
        const test::ArrayVolume volume = sampled(shape, 5, far);
        const auto open = [&](SweepChoice) { return std::make_unique<test::ArrayVolume>(volume); };
        return prepare_sections(open, SweepChoice::kAuto, options).between;
    };
    const PrepareOptions automatic{.between = std::nullopt};
    EXPECT_EQ(prepared(plate, 6, automatic), 5u);
    EXPECT_EQ(prepared(plate, 1, automatic), 0u) << "a cubic lattice";
    const auto wall = [](double x, double, double z) -> InputLabel { return x < 20 + z / 4; };
    EXPECT_EQ(prepared(wall, 6, automatic), 0u) << "all parts overlap";
    EXPECT_EQ(prepared(wall, 6, {.between = 2}), 2u);
    EXPECT_EQ(prepared(plate, 6, {}), 0u);
    EXPECT_THROW(prepared(plate, 6, {.between = kMostBetween + 1}), Error);
}

TEST(PrepareSections, knows_from_the_spacing_of_a_model_how_it_was_made) {
    Lattice lattice;
    lattice.spacing = {1, 1, 6};
    EXPECT_FALSE(between_of_model(lattice, {1, 1, 6}));
    EXPECT_FALSE(between_of_model(lattice, {1, 1, 4}));
    const auto made = between_of_model(lattice, {1, 1, 6.0 / 7});
    ASSERT_TRUE(made);
    EXPECT_EQ(made->between, 6u);
    EXPECT_EQ(made->axis, 2);
}

}  // namespace
}  // namespace regionmesh
