// Volumes that are written, read back.
#include "regionmesh/write_volume.h"

#include <gtest/gtest.h>

#include <numeric>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"
#include "support/in_single.h"

namespace regionmesh {
namespace {

class WriteVolume : public TemporaryFolder {
protected:
    std::filesystem::path written(const char* name, const Lattice& lattice, const Coordinates& coordinates) {
        const auto writer = create_volume(path(name), lattice, coordinates, SampleType::kU16, {.sync = false});
        for (std::uint32_t z = 0; z < lattice.size[2]; ++z)
            writer->write(std::span(labels_).subspan(std::size_t{z} * lattice.size[0] * lattice.size[1],
                                                     std::size_t{lattice.size[0]} * lattice.size[1]));
        writer->commit();
        return path(name);
    }

    std::vector<InputLabel> labels_ = [] {
        std::vector<InputLabel> labels(24);
        std::iota(labels.begin(), labels.end(), 1000);
        return labels;
    }();
};

TEST_F(WriteVolume, another_number_of_sections_or_samples_is_refused) {
    const Lattice lattice{.size = {4, 3, 2}};
    const auto writer = create_volume(path("v.npy"), lattice, {}, SampleType::kU16, {.sync = false});
    EXPECT_THROW(writer->write(std::span(labels_).first(11)), Error);
    writer->write(std::span(labels_).first(12));
    EXPECT_THROW(writer->commit(), Error);
    writer->write(std::span(labels_).first(12));
    EXPECT_THROW(writer->write(std::span(labels_).first(12)), Error);
}

TEST_F(WriteVolume, a_lattice_that_cannot_be_read_back_is_refused) {
    for (const double bad : {std::nan(""), 0.0, -1.0})
        EXPECT_THROW(create_volume(path("v.nii"), {.size = {4, 3, 2}, .spacing = {bad, 1, 1}}, {}, SampleType::kU16),
                     Error);
    EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

/// Oblique; its spacing is not one of single precision.
Lattice oblique() {
    Lattice lattice{.size = {4, 3, 2}};
    lattice.origin = {10.1, -20.2, 30.3};
    lattice.spacing = {0.5, 0.7, 2.3};
    lattice.direction = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, -1};
    return lattice;
}

void expect_same_place(const Lattice& a, const Lattice& b) {
    EXPECT_EQ(a.size, b.size);
    for (int row = 0; row < 3; ++row) {
        EXPECT_NEAR(a.origin[row], b.origin[row], 1e-14);
        EXPECT_NEAR(a.spacing[row], b.spacing[row], 1e-14);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(a.direction[3 * row + axis], b.direction[3 * row + axis], 1e-14);
    }
}

TEST_F(WriteVolume, keeps_the_place_in_every_space) {
    for (const Space space : {Space::kRas, Space::kLps})
        for (const char* name : {"v.nii", "v.nii.gz", "v.nrrd"}) {
            SCOPED_TRACE(std::string(name) + " " + space_name(space));
            ReadOptions options;
            options.space = space;
            const Volume back = read_volume({written(name, oblique(), {space})}, options);
            EXPECT_EQ(back.info.space, space);
            EXPECT_EQ(back.labels, labels_);
            expect_same_place(back.info.lattice, oblique());
        }
}

TEST_F(WriteVolume, nrrd_of_no_known_space_names_none) {
    const Volume back = read_volume({written("v.nrrd", oblique(), {})});
    EXPECT_EQ(back.info.space, Space::kUnknown);
    expect_same_place(back.info.lattice, oblique());
}

TEST_F(WriteVolume, nifti_has_single_precision_where_that_holds_the_affine) {
    Lattice lattice = oblique();
    EXPECT_EQ(text_of(written("v.nii", lattice, {Space::kRas})).substr(0, 2), "\x1C\x02") << "540: NIfTI-2";
    // Rounded to single precision, as a NIfTI-1 file would have it.
    for (int axis = 0; axis < 3; ++axis) {
        lattice.origin[axis] = test::in_single(lattice.origin[axis]);
        lattice.spacing[axis] = test::in_single(lattice.spacing[axis]);
    }
    lattice.direction = {0, -1, 0, 1, 0, 0, 0, 0, -1};
    EXPECT_EQ(text_of(written("v.nii", lattice, {Space::kLps})).substr(0, 2), "\x5C\x01") << "348: NIfTI-1";
    ReadOptions options;
    options.space = Space::kLps;
    expect_same_place(read_volume({path("v.nii")}, options).info.lattice, lattice);
}

TEST_F(WriteVolume, the_unit_of_length_is_kept_as_far_as_the_format_has_it) {
    Lattice single{.size = {4, 3, 2}};
    const auto back = [&](const char* name, const Lattice& lattice, std::optional<double> metres) {
        return read_volume({written(name, lattice, {.metres = metres})}).info.metres;
    };
    for (const Lattice& lattice : {single, oblique()})  // NIfTI-1 and NIfTI-2
        for (const char* name : {"v.nii", "v.nrrd"}) {
            EXPECT_EQ(back(name, lattice, std::nullopt), std::nullopt) << name;
            for (const double metres : {1.0, 1e-3, 1e-6}) EXPECT_EQ(back(name, lattice, metres), metres) << name;
        }
    EXPECT_EQ(back("v.nrrd", single, 0.3048), 0.3048);
    EXPECT_EQ(back("v.nii", single, 0.3048), std::nullopt) << "NIfTI has no feet";
    EXPECT_EQ(back("v.nrrd", single, 0.0123), std::nullopt) << "a unit without a name";
}

}  // namespace
}  // namespace regionmesh
