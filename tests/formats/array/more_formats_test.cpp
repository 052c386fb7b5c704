#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::filesystem::path more(const std::string& name) { return data("more/" + name); }

class MoreFormats : public TemporaryFolder {
protected:
    /// The file without its last bytes is refused, and nothing else happens.
    void expect_refusal_of_each_part(const std::string& name) {
        const std::string whole = text_of(more(name));
        const auto cut = path("cut" + more(name).extension().string());
        for (std::size_t length = 0; length + 8 < whole.size(); length += 7) {
            put_text(cut, whole.substr(0, length));
            EXPECT_THAT(refusal({cut}), testing::StartsWith(cut.string())) << name << " of " << length;
        }
    }
};

TEST_F(MoreFormats, npz_is_read_stored_and_deflated) {
    for (const char* name : {"stored.npz", "deflated.npz"}) {
        const Volume volume = read_volume({more(name)});
        EXPECT_EQ(volume.labels, expected(SampleType::kU16)) << name;
        EXPECT_EQ(volume.info.type, SampleType::kU16);
        EXPECT_EQ(volume.info.can_sweep[0], name[0] == 's');
        expect_refusal_of_each_part(name);
    }
}

TEST_F(MoreFormats, mrc_is_read_in_both_byte_orders_with_its_cell) {
    for (const char* name : {"bytes.mrc", "big_shorts.mrc", "reals.mrc"}) {
        const Volume volume = read_volume({more(name)});
        EXPECT_EQ(volume.labels, expected(SampleType::kU8)) << name;
        EXPECT_EQ(volume.info.lattice.spacing, (Vec3{2, 2, 4}));
        EXPECT_EQ(volume.info.lattice.origin, (Vec3{1, 2, 3}));
        EXPECT_EQ(volume.info.metres, 1e-10);
        expect_refusal_of_each_part(name);
    }
}

TEST_F(MoreFormats, legacy_vtk_is_read_as_text_and_binary) {
    for (const char* name : {"binary.vtk", "text.vtk", "field.vtk"}) {
        const Volume volume = read_volume({more(name)});
        EXPECT_EQ(volume.labels, expected(SampleType::kU8)) << name;
        EXPECT_EQ(volume.info.lattice.spacing, (Vec3{2, 2, 4}));
        EXPECT_EQ(volume.info.lattice.origin, (Vec3{1, 2, 3}));
    }
    expect_refusal_of_each_part("binary.vtk");
    put_text(path("a.vtk"), "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n");
    EXPECT_THAT(refusal({path("a.vtk")}), HasSubstr("holds a polydata"));
}

TEST_F(MoreFormats, label_fields_of_amira_are_read_in_all_codings) {
    for (const char* name : {"raw.am", "text.am", "runs.am", "zip.am"}) {
        SCOPED_TRACE(name);
        const Volume volume = read_volume({more(name)});
        std::vector<InputLabel> labels = expected(SampleType::kU8);
        if (std::string(name) == "runs.am") labels[0] = labels[1] = labels[2] = 7, labels[3] = 9;
        EXPECT_EQ(volume.labels, labels);
        EXPECT_EQ(volume.info.lattice.spacing, (Vec3{2, 2, 4}));
        EXPECT_EQ(volume.info.lattice.origin, (Vec3{1, 2, 3}));
        EXPECT_THAT(volume.info.names, ElementsAre(Pair(0, "Exterior"), Pair(1, "Bone")));
        EXPECT_THAT(volume.info.colours, ElementsAre(Pair(1, 0xff8000)));
    }
    for (const char* name : {"raw.am", "runs.am", "zip.am"}) expect_refusal_of_each_part(name);
}

TEST_F(MoreFormats, pages_of_tiff_are_turned_as_their_orientation_says) {
    // One page of 3 x 2 bytes 0 to 5, with the tag Orientation.
    const auto page = [&](char orientation) {
        const auto entry = [](int tag, int type, int value) {
            return std::string{char(tag & 255), char(tag >> 8), char(type), 0, 1, 0, 0, 0, char(value), 0, 0, 0};
        };
        std::string text("II*\0\x0e\0\0\0", 8);
        text += std::string("\0\1\2\3\4\5", 6) + std::string("\x09\0", 2);
        text += entry(256, 3, 3) + entry(257, 3, 2) + entry(258, 3, 8) + entry(259, 3, 1) + entry(262, 3, 1) +
                entry(273, 4, 8) + entry(274, 3, orientation) + entry(278, 3, 2) + entry(279, 4, 6);
        text += std::string(4, '\0');
        put_text(path("a.tif"), text);
        return read_volume({path("a.tif")}, swept(SweepChoice::kZ)).labels;
    };
    EXPECT_THAT(page(1), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(page(2), ElementsAre(2, 1, 0, 5, 4, 3));
    EXPECT_THAT(page(3), ElementsAre(5, 4, 3, 2, 1, 0));
    EXPECT_THAT(page(4), ElementsAre(3, 4, 5, 0, 1, 2));
    EXPECT_THAT(page(5), ElementsAre(0, 3, 1, 4, 2, 5));
    EXPECT_THAT(page(6), ElementsAre(3, 0, 4, 1, 5, 2));
    EXPECT_THAT(page(7), ElementsAre(5, 2, 4, 1, 3, 0));
    EXPECT_THAT(page(8), ElementsAre(2, 5, 1, 4, 0, 3));
}

TEST_F(MoreFormats, tesr_of_neper_is_read_as_text_and_binary_with_samples_in_the_middle_of_voxels) {
    for (const char* name : {"ascii.tesr", "short.tesr"}) {
        const Volume volume = read_volume({more(name)});
        EXPECT_EQ(volume.labels, expected(SampleType::kU16)) << name;
        EXPECT_EQ(volume.info.lattice.spacing, (Vec3{0.5, 0.25, 2}));
        EXPECT_EQ(volume.info.lattice.origin, (Vec3{1.25, 2.125, 4}));
        EXPECT_EQ(read_volume({more(name)}, spaced({1, 1, 1})).info.lattice.origin, (Vec3{1.5, 2.5, 3.5}));
        expect_refusal_of_each_part(name);
    }
}

TEST_F(MoreFormats, files_are_known_by_their_content_where_their_names_say_nothing) {
    const std::pair<const char*, const char*> files[]{{"more/text.am", "amira"},
                                                      {"more/ascii.tesr", "tesr"},
                                                      {"more/text.vtk", "vtk"},
                                                      {"nifti/version2_uint64.nii", "nifti"},
                                                      {"nifti/sform_uint8.nii.gz", "nifti"},
                                                      {"inr/uint8.inr", "inr"}};
    for (const auto& [name, format] : files) {
        SCOPED_TRACE(name);
        const Volume wanted = read_volume({data(name)});
        for (const char* other : {"labels", "labels.ims", "labels.bak"}) {
            put_text(path(other), text_of(data(name)));
            const Volume volume = read_volume({path(other)});
            EXPECT_EQ(volume.labels, wanted.labels) << other;
            EXPECT_EQ(volume.info.format, format) << other;
        }
    }
    put_text(path("notes"), "some text");
    EXPECT_THAT(refusal({path("notes")}), HasSubstr("unknown format"));
}

}  // namespace
}  // namespace regionmesh
