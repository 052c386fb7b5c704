#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "regionmesh/census.h"
#include "regionmesh/denoise.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

using Field = std::function<InputLabel(Vec3)>;

test::ArrayVolume sampled(const Field& label, std::array<std::uint32_t, 3> size, Vec3 spacing = {1, 1, 1}) {
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            for (std::uint32_t x = 0; x < size[0]; ++x)
                labels.push_back(label({x * spacing.x, y * spacing.y, z * spacing.z}));
    test::ArrayVolume volume(size, std::move(labels));
    volume.lattice().spacing = spacing;
    return volume;
}

InputLabel in_ball(Vec3 p) { return length(p - Vec3{19.7, 20.2, 20.4}) < 13.3; }

/// Copied from a lattice with samples `factor` times as far apart.
Field enlarged(const Field& label, double factor) {
    return [=](Vec3 p) {
        const auto middle = [&](double x) { return (std::floor((x + 0.5) / factor) + 0.5) * factor - 0.5; };
        return label({middle(p.x), middle(p.y), middle(p.z)});
    };
}

std::vector<InputLabel> read_all(SectionReader& reader) {
    std::vector<InputLabel> all, section(std::size_t{reader.section_width()} * reader.section_height());
    while (reader.next(section)) all.insert(all.end(), section.begin(), section.end());
    return all;
}

std::uint64_t differing(std::span<const InputLabel> a, std::span<const InputLabel> b) {
    std::uint64_t count = 0;
    for (std::size_t n = 0; n < a.size(); ++n) count += a[n] != b[n];
    return count;
}

test::ArrayVolume flipped(const test::ArrayVolume& volume, double share, std::uint32_t seed) {
    std::vector<InputLabel> labels = volume.labels();
    std::mt19937 random(seed);
    for (InputLabel& label : labels)
        if (random() < share * 0x1p32) label = 1 - label;
    return {volume.size(), std::move(labels)};
}

TEST(DenoisedSections, keeps_clean_labels) {
    std::mt19937 random(3);
    std::vector<Vec3> cells;
    for (int n = 0; n < 12; ++n) cells.push_back({random() % 40 * 1., random() % 40 * 1., random() % 40 * 1.});
    const Field shapes[] = {
        in_ball,
        [](Vec3 p) {
            return InputLabel{dot(p - Vec3{20, 20, 20}, {0.31, 0.17, 0.93}) < 0};
        },
        [](Vec3 p) {
            return InputLabel{std::max({std::abs(p.x - 20), std::abs(p.y - 20), std::abs(p.z - 20)}) < 9};
        },
        [](Vec3 p) { return InputLabel{std::hypot(p.x - 20, p.y - 0.4 * p.z - 12) < 2.1}; },
        [](Vec3 p) { return InputLabel{std::abs(p.x - 20) < 0.6}; },
        [](Vec3 p) { return InputLabel{std::sin(p.x / 4) * std::cos(p.y / 4) + std::sin(p.z / 4) > 0}; },
        [&](Vec3 p) {
            return std::ranges::min_element(cells, {}, [&](Vec3 c) { return length(c - p); }) - cells.begin();
        },
    };
    for (const auto& shape : shapes)
        for (const double wide : {1., 3.}) {
            test::ArrayVolume volume = sampled(shape, {40, 40, static_cast<std::uint32_t>(40 / wide)}, {1, 1, wide});
            DenoisedSections denoised(volume, {});
            EXPECT_FALSE(denoised.report().has_changes()) << &shape - shapes << " " << wide << denoised.report().text();
            EXPECT_EQ(denoised.report().roughness->text(), "clean") << &shape - shapes << " " << wide;
            EXPECT_EQ(differing(read_all(denoised), volume.labels()), 0u);
        }
}

TEST(DenoisedSections, makes_enlarged_labels_smooth) {
    const test::ArrayVolume truth = sampled(in_ball, {42, 42, 42});
    for (const double factor : {1.5, 2., 3.}) {
        test::ArrayVolume volume = sampled(enlarged(in_ball, factor), {42, 42, 42});
        DenoisedSections denoised(volume, {});
        ASSERT_TRUE(denoised.report().roughness->is_enlarged());
        for (const double found : denoised.report().roughness->enlarged) EXPECT_NEAR(found, factor, 0.05);
        const std::uint64_t before = differing(volume.labels(), truth.labels());
        EXPECT_LT(differing(read_all(denoised), truth.labels()), before * 2 / 3) << factor;
    }
}

TEST(DenoisedSections, takes_strays_and_bumps_away) {
    const test::ArrayVolume truth = sampled(in_ball, {42, 42, 42});
    test::ArrayVolume volume = flipped(truth, 0.01, 7);
    const std::uint64_t before = differing(volume.labels(), truth.labels());
    DenoisedSections denoised(volume, {});
    EXPECT_GT(denoised.report().specks, before / 2);
    EXPECT_LT(differing(read_all(denoised), truth.labels()), before / 5) << denoised.report().text();
}

/// Euler characteristics of regions, pairs with an interface, quadruple points.
LabelOracle oracle_of(SectionReader& reader, const LabelTable& labels) {
    reader.rewind();
    const Census census = count_labels(reader, {.background = {}});
    LabelTable all = labels;
    return relabelled(census.oracle, census.labels, all);
}

TEST(DenoisedSections, keeps_topology) {
    for (int seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        const InputLabel count = 2 + seed % 4;
        std::vector<Vec3> cells;
        for (int n = 0; n < count; ++n) cells.push_back({random() % 16 * 1., random() % 16 * 1., random() % 16 * 1.});
        test::ArrayVolume volume = sampled(
            [&](Vec3 p) {
                if (random() % 8 == 0) return InputLabel(random() % count);
                return std::ranges::min_element(cells, {}, [&](Vec3 c) { return length(c - p); }) - cells.begin();
            },
            {16, 17, 15}, {1, 1, seed % 2 ? 1 : 2.5});
        LabelTable labels;
        for (InputLabel label = 0; label < count; ++label) labels.dense(label);
        const LabelOracle before = oracle_of(volume, labels);
        volume.rewind();
        DenoisedSections denoised(volume, {.distance = 1.5, .specks = 0});
        EXPECT_GT(denoised.report().changed, 20u);
        EXPECT_EQ(denoised.report().cut_samples, 0u);
        const LabelOracle after = oracle_of(denoised, labels);
        EXPECT_EQ(after.euler, before.euler) << seed;
        EXPECT_EQ(after.quadruple_points_inside, before.quadruple_points_inside) << seed;
        EXPECT_EQ(after.region_pairs, before.region_pairs) << seed;
    }
}

TEST(DenoisedSections, does_not_depend_on_threads_or_on_rewinding) {
    test::ArrayVolume volume = sampled(enlarged(in_ball, 1.5), {40, 38, 36});
    for (const double distance : {kAutoDenoise, 2.}) {
        DenoisedSections one(volume, {.distance = distance, .threads = 1});
        const auto once = read_all(one);
        one.rewind();
        EXPECT_EQ(read_all(one), once);
        DenoisedSections four(volume, {.distance = distance, .threads = 4});
        EXPECT_EQ(read_all(four), once);
    }
    test::ArrayVolume noisy = flipped(volume, 0.03, 2), same = noisy;
    DenoisedSections one(noisy, {.threads = 1}), four(same, {.threads = 4});
    EXPECT_TRUE(one.report().has_changes());
    EXPECT_EQ(read_all(one), read_all(four));
}

TEST(DenoisedSections, gives_specks_to_their_neighbours_but_keeps_labels_that_are_small) {
    test::ArrayVolume volume = sampled(
        [](Vec3 p) {
            if (p == Vec3{3, 4, 5} || p == Vec3{3, 4, 6}) return InputLabel{1};  // a speck of the half space
            if (p == Vec3{15, 4, 5}) return InputLabel{0};                       // a cavity in it
            if (p == Vec3{4, 14, 9}) return InputLabel{7};                       // the only sample of its label
            return InputLabel{p.x > 9.5};
        },
        {20, 20, 20});
    DenoisedSections denoised(volume, {.distance = 0.4, .specks = 2});
    EXPECT_EQ(denoised.report().specks, 2u);
    EXPECT_EQ(denoised.report().speck_samples, 3u);
    EXPECT_EQ(denoised.report().largest_speck, 2u);
    const auto labels = read_all(denoised);
    EXPECT_EQ(labels[(5 * 20 + 4) * 20 + 3], 0);
    EXPECT_EQ(labels[(5 * 20 + 4) * 20 + 15], 1);
    EXPECT_EQ(labels[(9 * 20 + 14) * 20 + 4], 7);
    EXPECT_EQ(denoised.report().labels_left, 3u);
}

TEST(DenoisedSections, changes_nothing_if_it_is_off) {
    test::ArrayVolume volume = sampled(enlarged(in_ball, 2), {30, 30, 30});
    DenoisedSections denoised(volume, {.distance = 0});
    EXPECT_FALSE(denoised.report().roughness);
    EXPECT_EQ(differing(read_all(denoised), volume.labels()), 0u);
}

}  // namespace
}  // namespace regionmesh
