// A folder of pieces is compared, piece by piece, as the model that they make.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "regionmesh/blocks.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

const CompareOptions kFew{.samples = 30000, .background = {}, .threads = 2};

class CompareFolder : public testing::Test {
protected:
    CompareFolder() { fs::create_directory(root_); }
    ~CompareFolder() override { fs::remove_all(root_); }

    fs::path make(const test::ArrayVolume& volume, double reduce, std::uint32_t cells) const {
        const fs::path folder = root_ / std::to_string(cells);
        ReconstructOptions options{.reduce = reduce, .background = {}};
        options.smooth.reach = 2;
        const BlockOptions blocks{.folder = folder, .block_cells = cells, .identity = {}, .output = {.sync = false}};
        BlockTasks alone;
        reconstruct_blocks([&] { return std::make_unique<test::ArrayVolume>(volume); }, options, blocks, alone);
        return folder;
    }

private:
    const fs::path root_ = fs::temp_directory_path() / ("compare_folder_test." + std::to_string(::getpid()));
};

/// Grains in an oblique lattice that mirrors.
test::ArrayVolume grains() {
    test::ArrayVolume volume = test::grain_volume({33, 30, 28}, 20, 3);
    volume.lattice().direction = {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, -1};
    volume.lattice().origin = {5, -3, 11};
    return volume;
}

template <class Visit>
void for_distances(const CompareReport& report, Visit&& visit) {
    visit(report.distance);
    for (const auto& region : report.regions) visit(region.distance);
    for (const auto& interface : report.interfaces) visit(interface.distance);
    for (const auto& line : report.lines) visit(line.distance);
}

void expect_zero(const CompareReport& report) {
    for_distances(report, [](const TwoSidedDistance& distance) {
        ASSERT_TRUE(distance.both);
        EXPECT_EQ(distance.both->max, 0);
    });
}

/// What does not depend on where samples lie: counts, volumes, areas and lengths.
void expect_same_measures(const CompareReport& found, const CompareReport& expected) {
    EXPECT_EQ(found.faces, expected.faces);
    EXPECT_EQ(found.vertices, expected.vertices);
    EXPECT_EQ(found.distance.both->samples, expected.distance.both->samples);
    ASSERT_EQ(found.regions.size(), expected.regions.size());
    for (std::size_t n = 0; n < expected.regions.size(); ++n)
        for (int side = 0; side < 2; ++side) {
            const RegionReport &a = *found.regions[n].measures[side], &b = *expected.regions[n].measures[side];
            EXPECT_EQ(a.label, b.label);
            EXPECT_EQ(a.euler, b.euler);
            EXPECT_EQ(a.components, b.components);
            EXPECT_NEAR(a.volume, b.volume, 1e-9 * b.volume);
            EXPECT_NEAR(a.area, b.area, 1e-9 * b.area);
        }
    const auto compare_strata = [](const auto& some, const auto& others) {
        ASSERT_EQ(some.size(), others.size());
        for (std::size_t n = 0; n < others.size(); ++n) {
            EXPECT_EQ(some[n].labels, others[n].labels);
            for (int side = 0; side < 2; ++side)
                EXPECT_NEAR(*some[n].measures[side], *others[n].measures[side], 1e-9 * *others[n].measures[side]);
            EXPECT_EQ(some[n].distance.both->samples, others[n].distance.both->samples);
        }
    };
    compare_strata(found.interfaces, expected.interfaces);
    compare_strata(found.lines, expected.lines);
}

void expect_near(const DistanceStatistics& found, const DistanceStatistics& expected, double tolerance) {
    EXPECT_EQ(found.samples, expected.samples);
    EXPECT_NEAR(found.rms, expected.rms, tolerance * expected.rms);
    EXPECT_NEAR(found.mean, expected.mean, tolerance * expected.mean);
    EXPECT_NEAR(found.max, expected.max, tolerance * expected.max);
}

TEST_F(CompareFolder, is_at_no_distance_from_the_model_that_it_holds) {
    const fs::path folder = make(grains(), 0.5, 13);
    const MeshFile joined = read_block_folder(folder);
    const ComparedMesh whole{joined.mesh, joined.labels};
    const auto parts = open_block_folder(folder);
    EXPECT_GT(parts->part_count(), 8u);
    const CompareReport expected = compare(whole, whole, kFew);
    EXPECT_GT(expected.lines.size(), 50u);
    for (const CompareReport& report :
         {compare(*parts, whole, kFew), compare(whole, *parts, kFew), compare(*parts, *parts, kFew)}) {
        expect_zero(report);
        expect_same_measures(report, expected);
    }
}

TEST_F(CompareFolder, distances_are_those_of_the_joined_model) {
    test::ArrayVolume volume = grains();
    const fs::path coarse = make(volume, 0.8, 13), fine = make(volume, 0.2, 17);
    const MeshFile a = read_block_folder(fine), b = read_block_folder(coarse);
    const ComparedMesh whole_a{a.mesh, a.labels}, whole_b{b.mesh, b.labels};
    const CompareReport expected = compare(whole_a, whole_b, kFew);
    EXPECT_GT(expected.distance.both->rms, 0.01);
    const auto parts_a = open_block_folder(fine), parts_b = open_block_folder(coarse);
    const CompareReport to_parts = compare(whole_a, *parts_b, kFew), both = compare(*parts_a, *parts_b, kFew);
    expect_same_measures(to_parts, expected);
    expect_same_measures(both, expected);
    std::vector<TwoSidedDistance> distances;
    for_distances(expected, [&](const TwoSidedDistance& distance) { distances.push_back(distance); });
    std::size_t n = 0;  // the same samples of A find the same distances
    for_distances(to_parts, [&](const TwoSidedDistance& distance) {
        expect_near(*distance.a_to_b, *distances[n++].a_to_b, 1e-9);
    });
    EXPECT_EQ(n, distances.size());
    EXPECT_NEAR(both.distance.both->rms, expected.distance.both->rms, 0.03 * expected.distance.both->rms);
    EXPECT_NEAR(both.distance.both->mean, expected.distance.both->mean, 0.03 * expected.distance.both->mean);
}

TEST_F(CompareFolder, has_the_size_of_the_joined_model) {
    const fs::path folder = make(grains(), 0.5, 13);
    const ModelSize size = size_of_block_folder(folder), expected = size_of(read_block_folder(folder).mesh);
    EXPECT_EQ(size.faces, expected.faces);
    EXPECT_EQ(size.vertices, expected.vertices);
    EXPECT_EQ(size.box.low, expected.box.low);
    EXPECT_EQ(size.box.high, expected.box.high);
}

}  // namespace
}  // namespace regionmesh
