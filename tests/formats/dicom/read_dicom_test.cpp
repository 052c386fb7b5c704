#include <gmock/gmock.h>

#include <cmath>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

fs::path dicom(const std::string& name) { return data("dicom/" + name); }

/// Which labels make_dicom.py gives the samples of its 5 x 3 x 6 volumes.
InputLabel label_of(int x, int y, int z) { return z == 2 ? 0 : (x + 2 * y + 3 * z) % 4; }

std::vector<InputLabel> all_labels(const std::vector<int>& sections = {0, 1, 2, 3, 4, 5}) {
    std::vector<InputLabel> labels;
    for (const int z : sections)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x) labels.push_back(label_of(x, y, z));
    return labels;
}

/// origin, and direction * spacing by rows, of all volumes of 6 sections.
void expect_oblique(const VolumeInfo& info) {
    EXPECT_EQ(info.space, Space::kLps);
    EXPECT_EQ(info.metres, 1e-3);
    expect_in_space(info, {-10.5, 20.25, 30}, {0.18, -0.6, 1.2, 0.24, 0.45, 1.6, -0.4, 0, 1.5});
}

TEST(ReadDicom, masks_and_label_maps_of_every_transfer_syntax_are_the_same_volume) {
    const Paths files = files_in("dicom");
    int count = 0;
    for (const fs::path& file : files) {
        if (file.extension() != ".dcm") continue;
        SCOPED_TRACE(file);
        const Volume volume = read_volume({file});
        EXPECT_EQ(volume.info.format, "dicom");
        EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 3, 6}));
        EXPECT_EQ(volume.labels, all_labels());
        expect_oblique(volume.info);
        EXPECT_EQ(volume.info.warning, "");
        ++count;
    }
    EXPECT_EQ(count, 10);
}

TEST(ReadDicom, segments_have_names_and_colours) {
    const VolumeInfo info = open_sections({dicom("explicit.dcm")})->info();
    EXPECT_EQ(info.names, (LabelNames{{1, "liver"}, {2, "left kidney"}, {3, "spleen"}}));
    ASSERT_EQ(info.colours.size(), 2u) << "the third has none";
    EXPECT_EQ(info.colours.at(1), 0xFF0000u);
    EXPECT_EQ(info.colours.at(2), 0x00FF00u);
    EXPECT_EQ(open_sections({dicom("other/latin1.dcm")})->info().names.at(1), "Nebenh\xC3\xB6hle");
    EXPECT_EQ(open_sections({dicom("other/utf8.dcm")})->info().names.at(1), "\xE8\x82\x9D");
}

TEST(ReadDicom, a_palette_colours_segments_without_a_recommended_colour) {
    const LabelColours expected{{1, 0x800000}, {2, 0x00FF00}, {3, 0x000040}};
    EXPECT_EQ(open_sections({dicom("other/palette_8.dcm")})->info().colours, expected);
    EXPECT_EQ(open_sections({dicom("other/palette_16.dcm")})->info().colours, expected);
}

TEST(ReadDicom, samples_in_several_segments_have_the_highest_number_and_are_counted) {
    const Volume volume = read_volume({dicom("other/overlap.dcm")});
    std::vector<InputLabel> expected = all_labels();
    std::size_t count = 0;
    // Segment 3 has the samples of segment 1, too, in sections where it has some of its own: all but section 2.
    for (InputLabel& label : expected) {
        count += label == 1;
        if (label == 1) label = 3;
    }
    EXPECT_EQ(volume.labels, expected);
    EXPECT_EQ(
        volume.info.warning,
        std::to_string(count) + " samples are in several segments; they have the label of the highest segment number");
}

TEST(ReadDicom, padding_is_kept_where_a_segment_has_number_0) {
    const Volume volume = read_volume({dicom("other/map_zero.dcm")});
    std::vector<InputLabel> expected = all_labels();
    std::fill_n(expected.begin() + 30, 15, 255);  // the section without a frame
    EXPECT_EQ(volume.labels, expected);
    EXPECT_EQ(volume.info.names.at(0), "fluid");
}

TEST(ReadDicom, the_distance_of_sections_is_that_of_the_positions) {
    for (const char* name : {"other/no_distance.dcm", "other/rounded_between.dcm"}) {
        SCOPED_TRACE(name);
        const Volume volume = read_volume({dicom(name)});
        EXPECT_EQ(volume.labels, all_labels());
        EXPECT_NEAR(volume.info.lattice.spacing.z, 2.5, 2e-4);
    }
    const Volume sparse = read_volume({dicom("other/sparse.dcm")});
    EXPECT_EQ(sparse.labels, all_labels({0, 2, 2, 2, 4, 5})) << "SpacingBetweenSlices counts the missing ones";
    expect_oblique(sparse.info);
}

TEST(ReadDicom, a_wrong_distance_in_the_file_does_not_count) {
    const Volume volume = read_volume({dicom("other/wrong_between.dcm")});
    EXPECT_EQ(volume.labels, all_labels());
    EXPECT_EQ(volume.info.lattice.spacing.z, 2.5);
}

TEST(ReadDicom, one_section_without_a_thickness_needs_a_spacing) {
    const Paths file{dicom("other/one_section.dcm")};
    EXPECT_THAT(refusal(file), HasSubstr("give --spacing X,Y,Z"));
    const Volume volume = read_volume(file, spaced({1, 2, 3}));
    EXPECT_EQ(volume.labels, all_labels({0}));
    EXPECT_EQ(volume.info.lattice.spacing.z, 3);
}

TEST(ReadDicom, a_file_of_any_extension_is_known_by_its_content) {
    EXPECT_EQ(read_volume({dicom("other/1.2.3.4")}).labels, all_labels());
}

TEST(ReadDicom, samples_that_the_helper_holds_count_as_memory) {
    const auto held = [](const char* name) { return open_sections({dicom(name)})->info().held_bytes; };
    EXPECT_EQ(held("deflated.dcm"), held("explicit.dcm") + 30) << "15 frames of 15 bits, padded";
    EXPECT_GT(held("map_16_rle.dcm"), held("map_16.dcm") + 1000) << "the file";
}

TEST(ReadDicom, other_sweeps_and_layers_are_refused) {
    EXPECT_THAT(refusal({dicom("explicit.dcm")}, swept(SweepChoice::kX)), HasSubstr("only along z"));
    ReadOptions options;
    options.layer = 1;
    EXPECT_THAT(refusal({dicom("explicit.dcm")}, options), HasSubstr("--layer 1 is none"));
}

TEST(ReadDicom, what_is_not_a_regular_segmentation_is_refused_with_its_reason) {
    const std::vector<std::pair<const char*, const char*>> reasons{
        {"fractional", "is a fractional segmentation"},
        {"kind", "its segmentation type is 'SOLID'"},
        {"jpeg_ls", "compressed as JPEG-LS Lossless, which is not read; write them uncompressed"},
        {"part", "is part 1 of a segmentation in several files (a concatenation)"},
        {"bits", "its samples have 8 bits; BINARY segmentations have 1"},
        {"image", "is a DICOM object of modality CT, not a segmentation; segment the images"},
        {"beside", "frame 3: its position (-9.228, 21.946, 31.34) is 0.40 spacings off the grid"},
        {"between", "frame 3: its position (-8.82, 22.49, 32.1) is 0.40 spacings off the grid"},
        {"far", "check the positions of the frames"},
        {"no_position", "frame 2: has no position (ImagePositionPatient)"},
        {"no_segment", "frame 2: has no number of a segment"},
        {"no_orientation", "frame 1: has no orientation (ImageOrientationPatient)"},
        {"orientation",
         "frame 5: its orientation (1, 0, 0, 0, 1, 0) is not that of frame 1 (0.36, 0.48, -0.8, -0.8, 0.6, 0)"},
        {"flat", "frame 1: its orientation (1, 0, 0, 1, 0, 0) is not two perpendicular unit vectors"},
        {"spacing", "frame 5: its pixel spacing (1, 1) is not that of frame 1 (0.75, 0.5)"},
        {"no_spacing", "frame 1: its pixel spacing is 0 and 1"},
        {"twice", "frames 1 and 2 both hold segment"},
        {"groups", "has 15 frames, but describes 4"},
        {"short", "holds 4 bytes of samples where 29 are needed; the file is truncated"},
        {"long", "holds 32 bytes of samples where 29 are needed; its number of frames, rows or columns is wrong, or"},
        {"empty", "empty volume: 5 x 0 x 6 samples"},
        {"large", "is too small for the samples that it describes"},
        {"cut", "cannot be read as a DICOM file"},
        {"head", "cannot be read as a DICOM file"},
        {"text", "not a DICOM file"},
    };
    EXPECT_EQ(files_in("dicom/bad").size(), reasons.size()) << "each file has a reason here";
    for (const auto& [name, reason] : reasons) {
        const fs::path file = dicom("bad/" + std::string(name) + ".dcm");
        EXPECT_THAT(refusal({file}), StartsWith(file.string() + ": "));
        EXPECT_THAT(refusal({file}), HasSubstr(reason));
    }
}

using DicomFolder = TemporaryFolder;

TEST_F(DicomFolder, of_images_is_refused_with_or_without_extensions) {
    for (const char* name : {"IM0001", "a.dcm"}) {
        SCOPED_TRACE(name);
        const fs::path folder = path(std::string("series_") + name);
        fs::create_directory(folder);
        fs::copy_file(dicom("bad/image.dcm"), folder / name);
        EXPECT_THAT(refusal({folder}), StartsWith((folder / name).string() + ": is a DICOM file, which is no section"));
    }
    const Paths list{dicom("explicit.dcm"), dicom("implicit.dcm")};
    EXPECT_THAT(refusal(list), HasSubstr("name the file of the segmentation alone"));
}

}  // namespace
}  // namespace regionmesh
