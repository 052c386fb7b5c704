// The check of a folder, piece by piece, finds what the check of the whole finds.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "blocks/join.h"
#include "blocks/piece.h"
#include "regionmesh/blocks.h"
#include "regionmesh/census.h"
#include "support/random.h"
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
        PieceEntry& entry = manifest.pieces[block];
        manifest.faces += piece.faces.size() - entry.faces;
        entry.faces = piece.faces.size();
        entry.checksum = write_piece(piece, path, {.sync = false});
        write_manifest(manifest, folder_, {.sync = false});
    }

    const fs::path folder_ = fs::temp_directory_path() / ("check_folder_test." + std::to_string(::getpid()));
    std::optional<test::ArrayVolume> volume_;
};

/// Field by field.
void expect_same(const CheckReport& parts, const CheckReport& whole) {
    EXPECT_EQ(parts.counts, whole.counts);
    EXPECT_EQ(parts.region_pairs, whole.region_pairs);
    EXPECT_EQ(parts.quadruple_points_inside, whole.quadruple_points_inside);
    EXPECT_EQ(parts.lines.edges, whole.lines.edges);
    EXPECT_NEAR(parts.lines.length, whole.lines.length, 1e-6);
    EXPECT_NEAR(parts.lines.mean_turning_angle, whole.lines.mean_turning_angle, 1e-6);
    EXPECT_EQ(parts.quality.histogram, whole.quality.histogram);
    EXPECT_EQ(parts.quality.angle_histogram, whole.quality.angle_histogram);
    EXPECT_EQ(parts.quality.min, whole.quality.min);
    EXPECT_NEAR(parts.quality.mean, whole.quality.mean, 1e-9);
    EXPECT_NEAR(parts.quality.min_angle, whole.quality.min_angle, 1e-9);
    EXPECT_NEAR(parts.quality.max_angle, whole.quality.max_angle, 1e-9);
    ASSERT_EQ(parts.regions.size(), whole.regions.size());
    for (std::size_t n = 0; n < whole.regions.size(); ++n) {
        EXPECT_EQ(parts.regions[n].label, whole.regions[n].label) << n;
        EXPECT_EQ(parts.regions[n].euler, whole.regions[n].euler) << n;
        EXPECT_EQ(parts.regions[n].components, whole.regions[n].components) << n;
        EXPECT_NEAR(parts.regions[n].volume, whole.regions[n].volume, 1e-6) << n;
        EXPECT_NEAR(parts.regions[n].area, whole.regions[n].area, 1e-6) << n;
    }
}

TEST_F(CheckFolder, piece_by_piece_finds_the_same_as_the_whole) {
    make(test::grain_volume({33, 30, 28}, 20, 3), 0.7);
    MeshFile model = read_block_folder(folder_);
    const CheckOptions options = options_for(model);
    const CheckReport whole = check(model.mesh, options), parts = check_block_folder(folder_, options);
    test::expect_sound(whole);
    expect_same(parts, whole);
}

/// Balls of random regions in label 1 and in each other, and label 0 around them: many separate surfaces, regions of
/// many components, hollow ones, and some that several blocks share.
test::ArrayVolume balls(std::uint64_t seed) {
    constexpr std::uint32_t kSize = 34;
    test::Random random(seed);
    std::vector<InputLabel> labels(kSize * kSize * kSize, 1);
    const auto paint = [&](Vec3 middle, double radius, InputLabel label) {
        for (std::uint32_t n = 0; n < labels.size(); ++n) {
            const Vec3 p{1.0 * (n % kSize), 1.0 * (n / kSize % kSize), 1.0 * (n / kSize / kSize)};
            if (length(p - middle) < radius) labels[n] = label;
        }
    };
    for (int ball = 0; ball < 40; ++ball) {
        const Vec3 middle{random.between(2, 31), random.between(2, 31), random.between(2, 31)};
        const double radius = random.between(1.2, 6);
        const auto label = static_cast<InputLabel>(random.below(5));
        paint(middle, radius, label);
        paint(middle, radius - 1.5, (label + 1) % 5);
    }
    return {{kSize, kSize, kSize}, std::move(labels)};
}

/// Where parts of the surface lie in a wrong region, and the labels that meet there.
std::set<std::pair<std::array<double, 3>, std::vector<Label>>> misplaced_in(const CheckReport& report) {
    std::set<std::pair<std::array<double, 3>, std::vector<Label>>> found;
    for (const Violation& violation : report.violations)
        if (violation.kind == ViolationKind::kNesting)
            found.insert({{violation.at->x, violation.at->y, violation.at->z}, violation.labels});
    return found;
}

TEST_F(CheckFolder, components_and_nesting_are_those_of_the_whole) {
    std::uint64_t components = 0, misplaced = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        test::ArrayVolume volume = balls(seed);
        if (seed % 2 == 0) volume.lattice().direction = {0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, -1};
        make(std::move(volume), 0.3);
        MeshFile model = read_block_folder(folder_);
        CheckOptions options = options_for(model);
        const CheckReport whole = check(model.mesh, options);
        test::expect_sound(whole);
        expect_same(check_block_folder(folder_, options), whole);
        for (const RegionReport& region : whole.regions) components += region.components;
        // Islands of one region in a second one say that they lie in a third.
        for (std::uint32_t block = 0; block < read_manifest(folder_)->pieces.size(); ++block)
            change_piece(block, [](Piece& piece) {
                for (PieceFace& face : piece.faces)
                    if (std::ranges::is_permutation(face.labels, std::array<Label, 2>{1, 2}))
                        std::ranges::replace(face.labels, Label{1}, Label{3});
            });
        options.oracle.reset();
        const CheckReport found = check_block_folder(folder_, options),
                          expected = check(read_block_folder(folder_).mesh, options);
        expect_same(found, expected);
        EXPECT_EQ(misplaced_in(found), misplaced_in(expected));
        misplaced += found.counts[int(ViolationKind::kNesting)];
    }
    EXPECT_GT(components, 80u);
    EXPECT_GT(misplaced, 5u);
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
