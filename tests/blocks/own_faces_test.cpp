// Blocks have the faces of the whole volume, each once, with the same positions, bit for bit.
#include "blocks/own_faces.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "blocks/survey.h"
#include "regionmesh/census.h"
#include "stream/section_faces.h"
#include "stream/stage_options.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// A face by the places of its corners, the least first, and its labels.
using PlacedFace = std::array<double, 11>;

PlacedFace placed(std::array<Vec3, 3> corners, std::array<Label, 2> labels) {
    if (labels[1] < labels[0]) {
        std::swap(labels[0], labels[1]);
        std::swap(corners[1], corners[2]);
    }
    const auto less = [](const Vec3& a, const Vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less), corners.end());
    PlacedFace face{};
    for (int n = 0; n < 3; ++n)
        for (int axis = 0; axis < 3; ++axis) face[3 * n + axis] = corners[n][axis];
    face[9] = labels[0];
    face[10] = labels[1];
    return face;
}

std::vector<PlacedFace> faces_of_whole(test::ArrayVolume& volume, const ReconstructOptions& options) {
    const Reconstruction made = test::run(volume, options);
    std::vector<PlacedFace> faces;
    test::for_faces(made.mesh, [&](FaceId f) { faces.push_back(placed(made.mesh.corners(f), made.mesh[f].labels)); });
    std::sort(faces.begin(), faces.end());
    return faces;
}

bool is_same(const Chunk& a, const Chunk& b) {
    const auto vertex = [](const ChunkVertex& v, const ChunkVertex& w) {
        return v.position == w.position && v.sides == w.sides;
    };
    const auto face = [](const ChunkFace& f, const ChunkFace& g) {
        return f.vertices == g.vertices && f.labels == g.labels;
    };
    return std::ranges::equal(a.vertices, b.vertices, vertex) && std::ranges::equal(a.faces, b.faces, face) &&
           a.active == b.active && a.carried == 0 && b.carried == 0;
}

/// The faces of all blocks, by block.
std::vector<Chunk> swept_together(const BlockVolume& volume, const BlockGrid& grid, const ReconstructOptions& options) {
    std::vector<Chunk> found(grid.count());
    OwnFaces faces(volume, grid, {{0, 0, 0}, grid.counts()}, options);
    std::set<std::uint32_t> blocks;
    for (Chunk chunk; const auto block = faces.next(chunk);) {
        EXPECT_TRUE(blocks.insert(*block).second);
        found[*block] = std::move(chunk);
    }
    EXPECT_EQ(blocks.size(), grid.count());
    return found;
}

std::vector<PlacedFace> faces_of_blocks(test::ArrayVolume& volume, ReconstructOptions options, std::uint32_t size) {
    options = with_filter(options, SmoothFilter::kLattice);
    volume.rewind();
    const fs::path path = fs::temp_directory_path() / ("own_faces_test." + std::to_string(::getpid()));
    const VolumeInfo& info = volume.info();
    StagingFile copy(path, {.sync = false});
    const Survey survey = survey_sections(volume, {.background = options.background}, &copy);
    copy.commit();
    LabelTable labels = survey.labels;
    const std::vector<Label> background = dense_background(options.background, labels);
    const StagedLabels boxes(path, info.lattice, info.sweep);
    fs::remove(path);
    const CellKind cells = cell_kind(options);
    const BlockVolume blocks{.boxes = boxes,
                             .shape = section_shape(info, cells, 1),
                             .strips = {.cap = options.cap,
                                        .background = background,
                                        .cells = cells,
                                        .cuts = options.smooth.passes > 0 ? QuadCuts::kCones : QuadCuts::kBestQuality},
                             .labels = labels,
                             .background = background};
    const BlockGrid grid(blocks.shape.lattice, size);
    const std::vector<Chunk> swept = swept_together(blocks, grid, options);
    std::vector<PlacedFace> faces;
    for (std::uint32_t block = 0; block < grid.count(); ++block) {
        const auto [x, y, z] = grid.place(block);
        OwnFaces alone(blocks, grid, {{x, y, z}, {x + 1, y + 1, z + 1}}, options);
        Chunk chunk;
        EXPECT_EQ(alone.next(chunk), block);
        EXPECT_TRUE(is_same(chunk, swept[block])) << "block " << block << " depends on what is swept with it";
        for (const auto& [v, of] : chunk.faces)
            faces.push_back(placed(
                {chunk.vertices[v[0]].position, chunk.vertices[v[1]].position, chunk.vertices[v[2]].position}, of));
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

struct Case {
    const char* name;
    test::Size size;
    std::uint32_t grains, block;
    Sweep sweep;
    Vec3 spacing;
    ReconstructOptions options;
};

std::vector<Case> cases() {
    const ReconstructOptions smoothed{.decimate = false};
    const ReconstructOptions fine{.smooth = {.reach = 2}, .decimate = false, .background = {}};
    const ReconstructOptions open{.smooth = {.reach = 2}, .decimate = false, .cap = false};
    const ReconstructOptions rough{.smooth = {.passes = 0}, .decimate = false, .background = {}};
    const ReconstructOptions tetrahedra{.cells = CellKind::kTetrahedra, .smooth = {.reach = 2}, .decimate = false};
    return {
        {"the default, long along x", {190, 21, 20}, 40, 37, kSweepZ, {1, 1, 1}, smoothed},
        {"large grains, on which the coarsest fits are accepted", {210, 34, 33}, 4, 41, kSweepZ, {1, 1, 1}, smoothed},
        {"the default, swept along x", {190, 21, 20}, 40, 37, kSweepX, {1, 1, 1}, smoothed},
        {"spacing that rounds", {150, 16, 17}, 40, 31, kSweepZ, {0.3, 0.7, 0.3}, fine},
        {"wide sections far apart", {90, 84, 9}, 60, 29, kSweepZ, {0.1, 0.1, 0.55}, fine},
        {"swept along y", {20, 110, 18}, 50, 26, kSweepY, {1, 1, 1}, fine},
        {"open", {20, 24, 110}, 50, 26, kSweepZ, {1, 1, 1}, open},
        {"not smoothed", {31, 32, 33}, 30, 10, kSweepZ, {0.3, 0.3, 0.3}, rough},
        {"tetrahedra", {100, 14, 15}, 40, 33, kSweepZ, {1, 1, 1}, tetrahedra}};
}

TEST(Blocks, have_the_faces_of_the_whole_bit_for_bit) {
    for (Case& one : [] {
             static std::vector<Case> all = cases();
             return std::span(all);
         }()) {
        SCOPED_TRACE(one.name);
        test::ArrayVolume volume = test::grain_volume(one.size, one.grains, 7);
        volume.swept(one.sweep).spaced(one.spacing);
        volume.lattice().origin = {0.1, -3.7, 12.3};
        const std::vector<PlacedFace> whole = faces_of_whole(volume, one.options);
        ASSERT_GT(whole.size(), 1000u);
        const std::vector<PlacedFace> blocks = faces_of_blocks(volume, one.options, one.block);
        ASSERT_EQ(blocks.size(), whole.size());
        EXPECT_TRUE(blocks == whole);
    }
}

TEST(Blocks, share_the_vertices_that_faces_of_several_blocks_have) {
    const BlockGrid grid({.size = {11, 8, 5}}, 4, 1);
    EXPECT_EQ(grid.counts(), (std::array<std::uint32_t, 3>{3, 2, 2}));
    std::uint64_t cells = 0;
    for (std::uint32_t block = 0; block < grid.count(); ++block) {
        const IndexBox box = grid.cells(block);
        const auto size = box.size();
        cells += std::uint64_t{size[0]} * size[1] * size[2];
        const Vec3 middle{box.low[0] + 0.5, box.low[1] + 0.5, box.low[2] + 0.5};
        EXPECT_EQ(grid.block_at(middle), block);
        EXPECT_EQ(grid.limits(block).low.x, box.low[0]);
    }
    EXPECT_EQ(cells, 10u * 7 * 4);
}

}  // namespace
}  // namespace regionmesh
