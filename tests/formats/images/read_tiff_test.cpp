#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;
using ReadTiffTest = TemporaryFolder;

TEST_F(ReadTiffTest, pages_of_every_integer_type_layout_and_compression_come_back_label_for_label) {
    int count = 0;
    for (const auto& file : files_in("tiff")) {
        const std::string name = file.filename().string();
        if (name.find("rgb8") != std::string::npos || name.starts_with("tiles")) continue;
        const Volume volume = read_volume({file});
        EXPECT_EQ(volume.info.format, "tiff");
        EXPECT_EQ(volume.info.type, type_in_name(file)) << file;
        EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3})) << file;
        EXPECT_EQ(volume.labels, expected(type_in_name(file))) << file;
        ++count;
    }
    EXPECT_EQ(count, 19);
}

TEST_F(ReadTiffTest, tiles_are_put_together) {
    const Volume volume = read_volume({data("tiff/tiles_uint16.tif")});
    EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{20, 35, 3}));
    for (InputLabel z = 0, i = 0; z < 3; ++z) {
        for (InputLabel v = 0; v < 20 * 35; ++v, ++i) ASSERT_EQ(volume.labels[i], v + 1000 * z);
    }
}

TEST_F(ReadTiffTest, channels_are_packed_alike_beside_each_other_and_in_planes) {
    const auto rule = [](InputLabel v) { return v << 16 | 2 * v << 8 | (255 - v); };
    EXPECT_EQ(read_volume({data("tiff/beside_rgb8.tif")}).labels, expected(rule));
    EXPECT_EQ(read_volume({data("tiff/planes_rgb8.tif")}).labels, expected(rule));
}

TEST_F(ReadTiffTest, imagej_stack_in_one_page_has_all_its_sections_and_its_spacing) {
    const Volume volume = read_volume({data("tiff/imagej_uint16.tif")});
    EXPECT_EQ(volume.info.lattice.size[2], 3u);
    EXPECT_EQ(volume.info.lattice.spacing, (Vec3{0.25, 0.5, 3.5}));
    EXPECT_EQ(volume.info.metres, 1e-6);
    EXPECT_THAT(refusal({data("tiff/imagej_uint16.tif")}, swept(SweepChoice::kX)), HasSubstr("only along z"));
}

TEST_F(ReadTiffTest, imagej_stack_measured_in_pixels_has_no_spacing) {
    const std::string text = text_of(data("tiff/imagej_uint16.tif")), old = "mode=grayscale\nspacing=3.5\nunit=um\n";
    for (const std::string other :
         {"m=gray\nspacing=3.5\nunit=pixel\nab=c\n", "m=gray\nspacing=3.5\nunit=pixels\na=c\n"}) {
        ASSERT_EQ(other.size(), old.size());
        put_text(path("pixels.tif"), std::string(text).replace(text.find(old), old.size(), other));
        const VolumeInfo info = read_volume({path("pixels.tif")}).info;
        EXPECT_EQ(info.lattice.spacing, (Vec3{1, 1, 1}));
        EXPECT_EQ(info.metres, std::nullopt);
    }
}

TEST_F(ReadTiffTest, imagej_stack_of_frames_is_read_with_a_warning) {
    std::string text = text_of(data("tiff/imagej_pages_uint8.tif"));
    EXPECT_EQ(open_sections({data("tiff/imagej_pages_uint8.tif")})->info().warning, "");
    const std::size_t slices = text.find("slices=");
    ASSERT_NE(slices, std::string::npos);
    text.replace(slices, 6, "frames");
    put_text(path("times.tif"), text);
    EXPECT_THAT(open_sections({path("times.tif")})->info().warning, HasSubstr("its pages are frames"));
    EXPECT_EQ(read_volume({path("times.tif")}).labels, read_volume({data("tiff/imagej_pages_uint8.tif")}).labels);
}

TEST_F(ReadTiffTest, imagej_stack_cut_short_or_of_several_channels_is_refused) {
    const std::string whole = text_of(data("tiff/imagej_uint16.tif"));
    put_text(path("cut.tif"), whole.substr(0, whole.size() - 45));
    EXPECT_THAT(refusal({path("cut.tif")}), AllOf(HasSubstr("cut.tif: section "), HasSubstr("truncated")));
    EXPECT_THAT(refusal({data("tiff/bad/imagej_channels.tif")}),
                HasSubstr("has 3 channels; choose one with --layer 0 to 2"));
}

TEST_F(ReadTiffTest, whole_reals_are_labels) {
    EXPECT_EQ(read_volume({data("tiff/bad/float32.tif")}).labels, expected(SampleType::kU8));
}

TEST_F(ReadTiffTest, size_that_the_file_cannot_back_is_refused_before_anything_is_allocated) {
    std::string bytes = text_of(data("tiff/sections/s1.tif"));
    for (const char* tag : {"\x00\x01", "\x01\x01"}) {  // width and length, of two or four bytes
        bytes.replace(bytes.find(std::string(tag, 2) + '\x04') + 8, 4, std::string("\x00\x40\x00\x00", 4));
    }
    put_text(path("big.tif"), bytes);
    EXPECT_THAT(refusal({path("big.tif")}), HasSubstr("the image is 16384 x 16384 uint16, more than a file of"));
}

TEST_F(ReadTiffTest, tile_that_the_file_cannot_back_is_refused_before_it_is_allocated) {
    std::string bytes = text_of(data("tiff/tiles_uint16.tif"));
    for (const char* tag : {"\x42\x01\x04", "\x43\x01\x04"})  // width and length of a tile
        bytes.replace(bytes.find(tag) + 8, 2, std::string("\x00\x40", 2));
    put_text(path("big.tif"), bytes);
    EXPECT_THAT(refusal({path("big.tif")}), HasSubstr("a strip or tile is larger than the file can hold"));
}

TEST_F(ReadTiffTest, pages_of_another_size_are_named_with_both) {
    EXPECT_THAT(refusal({data("tiff/bad/page_sizes.tif")}),
                HasSubstr("section 1: the image is 5 x 3 uint8 where section 0 is 5 x 4 uint8"));
}

TEST_F(ReadTiffTest, file_cut_or_changed_anywhere_is_refused_or_read_and_nothing_is_printed) {
    for (const char* name : {"lzw_uint8.tif", "deflate_uint8.tif", "packbits_uint8.tif", "group4_bool.tif",
                             "tiles_uint16.tif", "imagej_uint16.tif"}) {
        const std::string whole = text_of(data(std::string("tiff/") + name));
        testing::internal::CaptureStderr();
        for (std::size_t place = 0; place < whole.size(); ++place) {
            put_text(path("a.tif"), whole.substr(0, place));
            EXPECT_THAT(refusal({path("a.tif")}), AnyOf(StartsWith(path("a.tif").string()), "nothing thrown")) << place;
            std::string changed = whole;
            changed[place] ^= 0x55;
            put_text(path("a.tif"), changed);
            EXPECT_THAT(refusal({path("a.tif")}), AnyOf(StartsWith(path("a.tif").string()), "nothing thrown")) << place;
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
}

TEST_F(ReadTiffTest, truncated_pages_are_named_by_their_section) {
    const std::string whole = text_of(data("tiff/sections/s2.tif"));
    put_text(path("cut.tif"), whole.substr(0, whole.size() - 8));
    EXPECT_THAT(refusal({data("tiff/sections/s1.tif"), path("cut.tif")}),
                AllOf(HasSubstr("cut.tif: section 1: "), HasSubstr("the TIFF file is damaged (")));
    put_text(path("no.tif"), "not a TIFF file at all");
    EXPECT_THAT(refusal({path("no.tif")}), HasSubstr("no.tif: section 0: the TIFF file is damaged (Not a TIFF"));
}

}  // namespace
}  // namespace regionmesh
