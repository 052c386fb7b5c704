// The check of a folder, piece by piece, finds what the check of the whole finds.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "blocks/join.h"
#include "blocks/piece.h"
#include "regionmesh/blocks.h"
#include "regionmesh/census.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class CheckFolder : public testing::Test {
protected:
    void make(test::ArrayVolume volume, double reduce) {
        volume_.emplace(std::move(volume));
        fs::remove_all(folder_);
        ReconstructOptions options{.reduce = reduce};
        options.smooth.reach = 2;
        const BlockOptions blocks{.folder = folder_, .block_cells = 13, .identity = {}, .output = {.sync = false}};
        BlockTasks alone;
        reconstruct_blocks([&] { return std::make_unique<test::ArrayVolume>(*volume_); }, options, blocks, alone);
    }
    ~CheckFolder() override { fs::remove_all(folder_); }

    /// Options with the background in the labels of a model, and with what the labels of the volume say.
    CheckOptions options_for(MeshFile& model) {
        CheckOptions options;
        for (const InputLabel label : *model.background) options.background.push_back(model.labels.dense(label));
        volume_->rewind();
        Census census = count_labels(*volume_);
        census.oracle.euler.resize(census.labels.size());
        options.oracle = census.oracle;  // both tables begin with the background, then in order of appearance
        return options;
    }

    /// Changes a piece of the folder, and its checksum in the manifest.
    template <class Change>
    void change_piece(std::uint32_t block, Change&& change) {
        Manifest manifest = *read_manifest(folder_);
        const fs::path path = piece_path(folder_, manifest.pieces[block].pass, block);
        Piece piece = read_piece(path);
        change(piece);
        manifest.pieces[block].checksum = write_piece(piece, path, {.sync = false});
        write_manifest(manifest, folder_, {.sync = false});
    }

    const fs::path folder_ = fs::temp_directory_path() / ("check_folder_test." + std::to_string(::getpid()));
    std::optional<test::ArrayVolume> volume_;
};

TEST_F(CheckFolder, piece_by_piece_finds_the_same_as_the_whole) {
    make(test::grain_volume({33, 30, 28}, 20, 3), 0.7);
    MeshFile model = read_block_folder(folder_);
    const CheckOptions options = options_for(model);
    const CheckReport whole = check(model.mesh, options), parts = check_block_folder(folder_, options);
    test::expect_sound(whole);
    test::expect_sound(parts);
    EXPECT_EQ(parts.region_pairs, whole.region_pairs);
    EXPECT_EQ(parts.quadruple_points_inside, whole.quadruple_points_inside);
    EXPECT_EQ(parts.lines.edges, whole.lines.edges);
    EXPECT_NEAR(parts.lines.length, whole.lines.length, 1e-6);
    EXPECT_EQ(parts.quality.histogram, whole.quality.histogram);
    EXPECT_EQ(parts.quality.min, whole.quality.min);
    ASSERT_EQ(parts.regions.size(), whole.regions.size());
    for (std::size_t n = 0; n < whole.regions.size(); ++n) {
        EXPECT_EQ(parts.regions[n].euler, whole.regions[n].euler) << n;
        EXPECT_NEAR(parts.regions[n].volume, whole.regions[n].volume, 1e-6) << n;
        EXPECT_NEAR(parts.regions[n].area, whole.regions[n].area, 1e-6) << n;
    }
}

TEST_F(CheckFolder, layers_are_voxelised_in_parts_where_they_have_many_faces) {
    test::ArrayVolume volume = test::grain_volume({30, 28, 27}, 12, 4);
    make(volume, 0.5);
    MeshFile model = read_block_folder(folder_);
    const CheckOptions options = options_for(model);
    const auto labels = [&](std::uint64_t most_faces) {
        std::vector<Label> all;
        const auto put = [&](std::span<const Label> section) { all.insert(all.end(), section.begin(), section.end()); };
        EXPECT_EQ(voxelise_block_folder(folder_, volume.info(), options.background, put, most_faces), 0u);
        return all;
    };
    const std::vector<Label> whole = labels(1'000'000);
    EXPECT_EQ(whole.size(), 30u * 28 * 27);
    for (const std::uint64_t most_faces : {1u, 700u, 3000u}) EXPECT_EQ(labels(most_faces), whole) << most_faces;
}

TEST_F(CheckFolder, finds_a_face_that_is_missing_and_one_that_was_moved) {
    make(test::grain_volume({30, 28, 27}, 12, 4), 0.5);
    MeshFile model = read_block_folder(folder_);
    const CheckOptions options = options_for(model);
    change_piece(4, [](Piece& piece) { piece.faces.erase(piece.faces.begin() + 5); });
    const CheckReport open = check_block_folder(folder_, options);
    const MeshFile damaged = read_block_folder(folder_);
    const CheckReport whole = check(damaged.mesh, options);
    EXPECT_GT(open.counts[int(ViolationKind::kOpenEdge)], 0u);
    EXPECT_EQ(open.counts[int(ViolationKind::kOpenEdge)], whole.counts[int(ViolationKind::kOpenEdge)]);
    EXPECT_EQ(open.counts[int(ViolationKind::kEuler)], whole.counts[int(ViolationKind::kEuler)]);
    make(test::grain_volume({30, 28, 27}, 12, 4), 0.5);
    // The first vertex of the fullest piece that is on no rim.
    const std::vector<PieceEntry> pieces = read_manifest(folder_)->pieces;
    const auto fullest = std::ranges::max_element(pieces, {}, &PieceEntry::faces) - pieces.begin();
    change_piece(static_cast<std::uint32_t>(fullest), [](Piece& piece) {
        const auto inside =
            std::ranges::find_if(piece.vertices, [](const PieceVertex& v) { return v.is_shared == 0 && v.sides == 0; });
        ASSERT_NE(inside, piece.vertices.end());
        inside->position = Vec3{29, 27, 26} - inside->position;  // at the other end of the volume
    });
    EXPECT_GT(check(read_block_folder(folder_).mesh, options).counts[int(ViolationKind::kCrossingFaces)], 0u);
    EXPECT_GT(check_block_folder(folder_, options).counts[int(ViolationKind::kCrossingFaces)], 0u);
}

TEST_F(CheckFolder, finds_a_seam_that_does_not_fit) {
    make(test::grain_volume({30, 28, 27}, 12, 4), 0.5);
    MeshFile model = read_block_folder(folder_);
    const CheckOptions options = options_for(model);
    change_piece(4, [](Piece& piece) {
        for (PieceVertex& vertex : piece.vertices)
            if (vertex.is_shared && vertex.sides == 0) {
                vertex.position.x += 1e-9;
                break;
            }
    });
    EXPECT_GT(check_block_folder(folder_, options).counts[int(ViolationKind::kOpenEdge)], 0u);
}

TEST_F(CheckFolder, samples_are_compared_in_layers) {
    for (const Sweep sweep : {kSweepX, kSweepY, kSweepZ}) {
        test::ArrayVolume volume = test::grain_volume({31, 27, 29}, 14, 6);
        volume.swept(sweep).spaced({0.3, 0.7, 1.1});
        volume.lattice().origin = {0.1, 5, -7.7};
        make(volume, 0.6);
        MeshFile model = describe_block_folder(folder_);
        const CheckOptions options = options_for(model);
        volume_->rewind();
        ASSERT_TRUE(has_lattice_of(folder_, volume_->info()));
        SampleAgreement samples = compare_block_samples(folder_, model.labels, options.background, *volume_);
        EXPECT_EQ(samples.samples, 31u * 27 * 29);
        EXPECT_EQ(samples.wrong, 0u);
        EXPECT_EQ(samples.contradictions, 0u);
        // Another volume has samples in other regions.
        test::ArrayVolume other = test::grain_volume({31, 27, 29}, 14, 7);
        other.swept(sweep);
        samples = compare_block_samples(folder_, model.labels, options.background, other);
        EXPECT_GT(samples.wrong, 1000u);
    }
}

}  // namespace
}  // namespace regionmesh
