// Labels back on the lattice, exactly.
#include "regionmesh/voxelise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "regionmesh/error.h"
#include "regionmesh/reconstruct.h"
#include "support/in_single.h"
#include "support/meshes.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

using test::ArrayVolume;

ReconstructOptions plain(std::vector<InputLabel> background = {}) {
    ReconstructOptions options;
    options.smooth.passes = 0;
    options.background = std::move(background);
    return options;
}

SampleAgreement agreement(ArrayVolume volume, const ReconstructOptions& options) {
    Reconstruction made = reconstruct(volume, options);
    volume.rewind();
    return compare_samples(made.mesh, made.labels, made.background, volume);
}

void expect_lossless(const ArrayVolume& volume, const ReconstructOptions& options) {
    const SampleAgreement found = agreement(volume, options);
    EXPECT_EQ(found.samples, std::uint64_t{volume.size()[0]} * volume.size()[1] * volume.size()[2]);
    EXPECT_EQ(found.wrong, 0u);
    EXPECT_EQ(found.contradictions, 0u);
    EXPECT_EQ(found.dice(), 1);
}

TEST(Voxelise, refuses_other_sweeps_and_room_for_another_section) {
    ArrayVolume volume = test::noise_volume({6, 5, 4}, 2, 1);
    const Reconstruction made = reconstruct(volume, plain());
    EXPECT_THROW(Voxeliser(made.mesh, {.lattice = volume.lattice(), .sweep = {{5, 7, 9}}}), Error);
    Voxeliser voxeliser(made.mesh, {.lattice = volume.lattice()});
    std::vector<Label> section(29);
    EXPECT_THROW(voxeliser.next(section), Error);
    section.resize(30);
    EXPECT_TRUE(voxeliser.next(section));
}

TEST(Voxelise, plain_models_of_noise_are_lossless) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        expect_lossless(test::noise_volume({6, 5, 4}, 2 + seed % 5, seed, seed % 3 == 0 ? 0 : -1), plain());
}

TEST(Voxelise, background_without_caps_is_lossless) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
        expect_lossless(test::noise_volume({6, 5, 4}, 4, seed), plain({0}));
}

TEST(Voxelise, sweeps_spacings_and_origins_are_lossless) {
    for (const Sweep sweep : {kSweepX, kSweepY, kSweepZ}) {
        ArrayVolume volume = test::grain_volume({9, 8, 7}, 12, 3);
        volume.spaced({0.3, 1.7, 5}).swept(sweep);
        volume.lattice().origin = {-17.1, 1e3 / 3, 0.1};
        expect_lossless(volume, plain());
    }
}

/// Grains in a lattice that is turned about z by an angle of this sine.
ArrayVolume turned_grains(double sine) {
    ArrayVolume volume = test::grain_volume({9, 8, 7}, 12, 3);
    volume.spaced({0.3, 0.7, 1.1});
    volume.lattice().origin = {10.1, -3.3, 7.7};
    const double cosine = std::sqrt(1 - sine * sine);
    volume.lattice().direction = {cosine, -sine, 0, sine, cosine, 0, 0, 0, 1};
    return volume;
}

void round_to_single(Mesh& mesh) {
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        Vec3& p = mesh[VertexId{v}].position;
        for (int axis = 0; axis < 3; ++axis) p[axis] = test::in_single(p[axis]);
    }
}

TEST(Voxelise, positions_rounded_to_single_precision_leave_no_sample_on_a_side_outside) {
    for (const double sine : {0.0, 0.6}) {
        ArrayVolume volume = turned_grains(sine);
        Reconstruction made = reconstruct(volume, plain());
        round_to_single(made.mesh);
        volume.rewind();
        const SampleAgreement found = compare_samples(made.mesh, made.labels, made.background, volume);
        EXPECT_EQ(found.wrong, 0u) << sine;
        EXPECT_EQ(found.contradictions, 0u) << sine;
    }
}

TEST(Voxelise, far_from_the_origin_only_what_was_rounded_is_put_back) {
    // Whole numbers and halves, as of unsmoothed models, are numbers of single precision without being rounded.
    for (const double mirror : {1.0, -1.0})
        for (const double offset : {0.0, 0.3}) {
            ArrayVolume volume = test::grain_volume({12, 11, 10}, 12, 3);
            volume.spaced({10, 10, 1});
            volume.lattice().origin = {512345 + offset, 5912345 + offset, -20};
            volume.lattice().direction = {mirror, 0, 0, 0, mirror, 0, 0, 0, 1};
            expect_lossless(volume, plain());
            volume.rewind();
            Reconstruction made = reconstruct(volume, plain());
            round_to_single(made.mesh);
            volume.rewind();
            const SampleAgreement found = compare_samples(made.mesh, made.labels, made.background, volume);
            EXPECT_EQ(found.wrong, 0u) << mirror << ' ' << offset;
            EXPECT_EQ(found.contradictions, 0u) << mirror << ' ' << offset;
        }
}

TEST(Voxelise, a_lattice_of_single_precision_is_that_of_the_model) {
    // As NIfTI has it: spacings and origins are rounded, and so is the model, from the numbers before or after.
    for (const double sine : {0.0, 0.6})
        for (const double origin : {0.0, -17.3}) {
            ArrayVolume volume = test::grain_volume({4, 57, 3}, 12, 3);
            volume.spaced({0.3, 0.3, 0.7});
            Lattice& lattice = volume.lattice();
            const double cosine = std::sqrt(1 - sine * sine);
            lattice.origin = {origin, origin, origin};
            lattice.direction = {cosine, -sine, 0, sine, cosine, 0, 0, 0, 1};
            Reconstruction made = reconstruct(volume, plain());
            round_to_single(made.mesh);
            for (int axis = 0; axis < 3; ++axis) {
                lattice.spacing[axis] = test::in_single(lattice.spacing[axis]);
                lattice.origin[axis] = test::in_single(lattice.origin[axis]);
            }
            volume.rewind();
            const SampleAgreement found = compare_samples(made.mesh, made.labels, made.background, volume);
            EXPECT_EQ(found.wrong, 0u) << sine << ' ' << origin;
            EXPECT_EQ(found.contradictions, 0u) << sine << ' ' << origin;
        }
}

/// A lattice of `size` samples, whose sample 0 is sample `first` of the volume.
void expect_lossless_in(const Lattice& part, const std::array<int, 3>& first, const ArrayVolume& volume,
                        const Reconstruction& made) {
    Voxeliser voxeliser(made.mesh, {.lattice = part});
    std::vector<Label> section(std::size_t{part.size[0]} * part.size[1]);
    std::uint32_t wrong = 0;
    for (std::uint32_t z = 0; voxeliser.next(section); ++z)
        for (std::uint32_t y = 0; y < part.size[1]; ++y)
            for (std::uint32_t x = 0; x < part.size[0]; ++x) {
                const Label label = section[std::size_t{y} * part.size[0] + x];
                const std::uint32_t i = x + first[0], j = y + first[1], k = z + first[2];  // wraps below the volume
                const auto& [nx, ny, nz] = volume.size();
                if (i < nx && j < ny && k < nz)
                    wrong += is_exterior(label) || made.labels.input(label) != volume.at(i, j, k);
                else
                    wrong += label != kNoRegion;
            }
    EXPECT_EQ(wrong, 0u) << part.size[0] << ' ' << part.size[1] << ' ' << part.size[2] << " at " << first[0] << ' '
                         << first[1] << ' ' << first[2];
    EXPECT_EQ(voxeliser.contradictions(), 0u);
}

TEST(Voxelise, samples_on_the_sides_of_a_model_have_the_region_inside_in_any_lattice) {
    for (const double sine : {0.0, 0.6})
        for (const bool is_single : {false, true}) {
            ArrayVolume volume = turned_grains(sine);
            Reconstruction made = reconstruct(volume, plain());
            if (is_single) round_to_single(made.mesh);
            // Larger, smaller, beyond a side, on one side alone, and one sample across.
            const std::array<std::pair<int, int>, 7> kRanges{
                {{-2, 2}, {0, 0}, {2, -2}, {-3, -6}, {3, 2}, {0, -6}, {6, 0}}};  // more below, and more above
            for (int axis = 0; axis < 3; ++axis)
                for (const auto& [below, above] : kRanges) {
                    std::array<int, 3> first{};
                    first[axis] = below;
                    Lattice part = volume.lattice();
                    part.size[axis] = part.size[axis] + above - below;
                    for (int row = 0; row < 3; ++row)
                        part.origin[row] += below * part.spacing[axis] * part.direction[3 * row + axis];
                    expect_lossless_in(part, first, volume, made);
                }
        }
}

TEST(Voxelise, samples_between_those_of_the_volume_do_not_disturb_them) {
    constexpr std::uint32_t kParts = 3;
    ArrayVolume volume = turned_grains(0);
    const Reconstruction made = reconstruct(volume, plain());
    Lattice fine = volume.lattice();
    for (int axis = 0; axis < 3; ++axis) {
        fine.size[axis] = kParts * (fine.size[axis] - 1) + 1;
        fine.spacing[axis] /= kParts;
    }
    Voxeliser voxeliser(made.mesh, {.lattice = fine});
    std::vector<Label> section(std::size_t{fine.size[0]} * fine.size[1]);
    std::uint32_t wrong = 0;
    for (std::uint32_t z = 0; voxeliser.next(section); ++z)
        for (std::uint32_t n = 0; n < section.size(); ++n) {
            const std::uint32_t x = n % fine.size[0], y = n / fine.size[0];
            if (x % kParts + y % kParts + z % kParts > 0) continue;
            wrong += is_exterior(section[n]) ||
                     made.labels.input(section[n]) != volume.at(x / kParts, y / kParts, z / kParts);
        }
    EXPECT_EQ(wrong, 0u);
}

TEST(Voxelise, oblique_and_mirrored_lattices_are_lossless) {
    for (const double mirror : {1.0, -1.0}) {
        ArrayVolume volume = test::grain_volume({9, 8, 7}, 12, 4);
        const double c = 0.8, s = 0.6;
        volume.lattice().direction = {c, -s, 0, s, c, 0, 0, 0, mirror};
        volume.lattice().origin = {5, -3, 11};
        expect_lossless(volume, plain());
    }
}

TEST(Voxelise, rotations_of_few_digits_and_sheared_lattices_are_lossless) {
    // As files have them: turned about three axes and rounded to floats or to three digits; a tilted scanner.
    const std::array<std::array<double, 9>, 3> directions{{
        {0.97517031f, -0.03695701f, 0.21835066f, 0.0978434f, 0.95642507f, -0.27509585f, -0.19866933f, 0.28962949f,
         0.93629336f},
        {0.975, -0.037, 0.218, 0.098, 0.956, -0.275, -0.199, 0.29, 0.936},
        {1, 0.4472135954999579, 0, 0, 0.8944271909999159, 0, 0, 0, 1},
    }};
    for (const auto& direction : directions)
        for (const Sweep sweep : {kSweepX, kSweepY, kSweepZ}) {
            ArrayVolume volume = test::grain_volume({9, 8, 7}, 12, 5);
            volume.spaced({0.3, 1.7, 1}).swept(sweep);
            volume.lattice().direction = direction;
            volume.lattice().origin = {-2e4, 1e5 / 3, 11};
            expect_lossless(volume, plain());
        }
}

TEST(Voxelise, decimated_flat_interfaces_are_lossless) {
    // Two halves: the large faces that are left cross many rows.
    std::vector<InputLabel> labels;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 12; ++x) labels.push_back(x < 5 ? 1 : y < 7 ? 2 : 3);
    ReconstructOptions options = plain();
    options.reduce = 0.95;
    expect_lossless(ArrayVolume({12, 12, 12}, labels), options);
}

TEST(Voxelise, samples_that_moved_to_another_region_are_counted) {
    ArrayVolume volume = test::ball_volume({12, 12, 12}, 4);
    Reconstruction made = reconstruct(volume, plain({0}));
    std::vector<InputLabel> changed = volume.labels();
    changed[6 + 12 * (6 + 12 * 6)] = 0;
    changed[0] = 1;
    ArrayVolume other({12, 12, 12}, changed);
    const SampleAgreement found = compare_samples(made.mesh, made.labels, made.background, other);
    EXPECT_EQ(found.wrong, 2u);
    EXPECT_EQ(found.dice(), 1 - 1. / static_cast<double>(found.regions[made.labels.dense(1)].in_sections))
        << "without the background: a sample gone, and another come";
    EXPECT_EQ(found.regions[made.labels.dense(1)].in_both + 1, found.regions[made.labels.dense(1)].in_sections);
}

TEST(Voxelise, no_hole_goes_unnoticed) {
    // A line that enters through a hole, or stays inside because it would have left through one.
    ArrayVolume volume = test::ball_volume({8, 7, 6}, 2.5);
    const Reconstruction whole = reconstruct(volume, plain());
    for (std::uint32_t f = 0; f < whole.mesh.face_end(); ++f) {
        volume.rewind();
        Reconstruction made = reconstruct(volume, plain());
        made.mesh.remove_face(FaceId{f});
        volume.rewind();
        const SampleAgreement found = compare_samples(made.mesh, made.labels, made.background, volume);
        EXPECT_TRUE(found.wrong == 0 || found.contradictions > 0) << "without face " << f;
    }
}

TEST(Voxelise, a_surface_with_a_hole_contradicts_itself) {
    ArrayVolume volume = test::ball_volume({12, 12, 12}, 4);
    Reconstruction made = reconstruct(volume, plain());
    for (std::uint32_t f = 0; f < made.mesh.face_end(); ++f)
        if (made.mesh.is_alive(FaceId{f}) && made.mesh.corners(FaceId{f})[0].x > 8) made.mesh.remove_face(FaceId{f});
    volume.rewind();
    const SampleAgreement found = compare_samples(made.mesh, made.labels, made.background, volume);
    EXPECT_GT(found.wrong, 0u);
}

TEST(Voxelise, refuses_a_lattice_without_samples) {
    const Mesh mesh;
    EXPECT_THROW(Voxeliser(mesh, {.lattice = {}}), Error);
    EXPECT_THROW(Voxeliser(mesh, {.lattice = {.size = {2, 0, 2}}}), Error);
}

}  // namespace
}  // namespace regionmesh
