#include <gmock/gmock.h>
#include <zlib.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"
#include "formats/text/natural_order.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ReadImagesTest : public TemporaryFolder {
protected:
    // A copy of a folder of sections, to spoil.
    fs::path copy_of(const std::string& folder) {
        fs::copy(data(folder), path("copy"));
        return path("copy");
    }
};

InputLabel pack(InputLabel alpha, InputLabel red, InputLabel green, InputLabel blue, int bits) {
    return alpha << 3 * bits | red << 2 * bits | green << bits | blue;
}

TEST(NaturalOrder, digits_compare_as_numbers) {
    EXPECT_TRUE(formats::natural_less("s2.png", "s10.png"));
    EXPECT_FALSE(formats::natural_less("s10.png", "s2.png"));
    EXPECT_TRUE(formats::natural_less("s002.png", "s10.png"));
    EXPECT_TRUE(formats::natural_less("s2.png", "s02.png"));
    EXPECT_FALSE(formats::natural_less("s02.png", "s2.png"));
    EXPECT_TRUE(formats::natural_less("a9b10", "a10b9"));
    EXPECT_TRUE(formats::natural_less("s18446744073709551616", "s18446744073709551617"));
    EXPECT_TRUE(formats::natural_less("s", "s0"));
    EXPECT_FALSE(formats::natural_less("s1", "s1"));
    EXPECT_TRUE(formats::natural_less("s0", "s00"));
}

TEST_F(ReadImagesTest, png_folders_hold_the_values_as_stored_in_natural_order) {
    struct Case {
        const char* folder;
        SampleType type;
        std::function<InputLabel(InputLabel)> rule;
    };
    const auto rgb8 = [](InputLabel v) { return pack(0, v, 2 * v, 255 - v, 8); };
    const std::vector<Case> cases{
        {"gray1", SampleType::kU1, [](InputLabel v) { return v % 3 == 0; }},
        {"gray8", SampleType::kU8, [](InputLabel v) { return v; }},
        {"gray16", SampleType::kU16, [](InputLabel v) { return v * 1000; }},
        {"palette2", SampleType::kU8, [](InputLabel v) { return v % 4; }},
        {"palette8", SampleType::kU8, [](InputLabel v) { return v % 4; }},
        {"gray_alpha8", SampleType::kU16, [](InputLabel v) { return 2 * v << 8 | v; }},
        {"rgb8", SampleType::kU32, rgb8},
        {"interlaced_rgb8", SampleType::kU32, rgb8},
        {"rgba8", SampleType::kU32, [](InputLabel v) { return pack(255 - 3 * v, v, 2 * v, 255 - v, 8); }},
        {"rgb16", SampleType::kU64, [](InputLabel v) { return pack(0, 256 * v, 512 * v, 65280 - 256 * v, 16); }},
        {"rgba16", SampleType::kU64,
         [](InputLabel v) { return pack(65280 - 768 * v, 256 * v, 512 * v, 65280 - 256 * v, 16); }}};
    for (const auto& [folder, type, rule] : cases) {
        const Volume volume = read_volume({data(std::string("png/") + folder)});
        EXPECT_EQ(volume.info.format, "png");
        EXPECT_EQ(volume.info.source, data(std::string("png/") + folder).string());
        EXPECT_EQ(volume.info.type, type) << folder;
        EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
        EXPECT_EQ(volume.info.sweep.axes, kSweepZ.axes);
        EXPECT_EQ(volume.labels, expected(rule)) << folder;
    }
}

TEST_F(ReadImagesTest, alpha_is_worth_a_warning) {
    const auto warning = [&](const char* folder) { return open_sections({data(folder)})->info().warning; };
    EXPECT_THAT(warning("png/rgba8"), HasSubstr("opaque black is 4278190080, not 0"));
    EXPECT_THAT(warning("png/rgba16"), HasSubstr("opaque black is 18446462598732840960, not 0"));
    EXPECT_THAT(warning("png/gray_alpha8"), HasSubstr("opaque black is 65280, not 0"));
    EXPECT_EQ(warning("png/rgb8"), "");
    EXPECT_EQ(warning("png/gray8"), "");
}

TEST_F(ReadImagesTest, a_gap_and_alpha_are_worth_one_warning) {
    const fs::path image = *fs::directory_iterator(data("png/rgba8"));
    for (const int number : {1, 2, 3, 5, 6}) fs::copy_file(image, path("s" + std::to_string(number) + ".png"));
    const std::string warning = open_sections({path("")})->info().warning;
    EXPECT_THAT(warning, HasSubstr("s5.png"));
    EXPECT_THAT(warning, HasSubstr("; pixels have alpha"));
}

TEST_F(ReadImagesTest, tiff_folders_are_read_like_png_folders) {
    EXPECT_EQ(read_volume({data("tiff/sections")}).labels, expected(SampleType::kU16));
    EXPECT_EQ(read_volume({data("tiff/palette8")}).labels, expected([](InputLabel v) { return v % 4; }));
}

TEST_F(ReadImagesTest, list_keeps_the_order_given_and_is_named_by_its_first_file) {
    const fs::path folder = data("png/gray8");
    const Volume volume = read_volume({folder / "s10.png", folder / "s1.png"});
    EXPECT_EQ(volume.info.source, (folder / "s10.png").string());
    EXPECT_EQ(volume.info.lattice.size[2], 2u);
    EXPECT_EQ(volume.labels[0], 40);
    EXPECT_EQ(volume.labels[20], 0);
}

TEST_F(ReadImagesTest, one_image_is_one_section) {
    EXPECT_EQ(open_sections({data("png/gray8/s1.png")})->info().lattice.size, (std::array<std::uint32_t, 3>{5, 4, 1}));
    EXPECT_EQ(open_sections({data("tiff/sections/s1.tif")})->info().lattice.size,
              (std::array<std::uint32_t, 3>{5, 4, 1}));
}

TEST_F(ReadImagesTest, other_files_of_a_folder_are_passed_over_but_not_other_images) {
    const fs::path folder = copy_of("png/gray8");
    for (const char* name : {"notes.txt", "meta.json", ".hidden.png", "Thumbs.db"}) put_text(folder / name, "x");
    fs::create_directory(folder / "below.png");
    EXPECT_EQ(read_volume({folder}).labels, expected(SampleType::kU8));
    put_text(folder / "s3.JPG", "x");
    EXPECT_THAT(refusal({folder}), AllOf(HasSubstr("s3.JPG: "), HasSubstr("convert the sections to PNG or TIFF")));
    fs::remove(folder / "s3.JPG");
    fs::copy_file(data("tiff/sections/s1.tif"), folder / "s1.tif");
    EXPECT_THAT(refusal({folder}), HasSubstr("both PNG and TIFF"));
}

TEST_F(ReadImagesTest, a_gap_in_the_numbers_of_sections_is_worth_a_warning) {
    const auto warning = [&](const std::vector<std::string>& names) {
        const fs::path folder = path("numbered");
        fs::remove_all(folder);
        fs::create_directory(folder);
        for (const std::string& name : names) fs::copy_file(data("png/gray8/s1.png"), folder / name);
        return open_sections({folder})->info().warning;
    };
    EXPECT_EQ(warning({"s1.png", "s2.png", "s3.png", "s4.png", "s5.png"}), "");
    EXPECT_EQ(warning({"a 08 x.png", "a 10 x.png", "a 12 x.png", "a 14 x.png", "a 16 x.png"}), "");
    EXPECT_EQ(warning({"s8.png", "s9.png", "s10.png", "s12.png", "s13.png"}),
              "s10.png is followed by s12.png, and other numbers rise by 1: if a section is missing, put one in, since "
              "sections are read as equally far apart");
    EXPECT_EQ(warning({"s1.png", "s2.png", "s3.png", "s5.png"}), "") << "too few to tell";
    EXPECT_EQ(warning({"s1.png", "s3.png", "s4.png", "s7.png", "s12.png"}), "") << "positions, perhaps";
    EXPECT_EQ(warning({"a1.png", "a2.png", "b1.png", "b2.png", "b4.png"}), "") << "two kinds";
    EXPECT_EQ(warning({"a.png", "b.png", "c.png", "d.png", "f.png"}), "") << "no numbers";
    EXPECT_EQ(warning({"s0.png", "s1.png", "s2.png", "s3.png", "s99999999999999999999.png"}), "") << "no 64 bits";
}

TEST_F(ReadImagesTest, folder_without_images_is_refused) {
    fs::create_directory(path("empty"));
    put_text(path("empty") / "notes.txt", "x");
    EXPECT_THAT(refusal({path("empty")}), HasSubstr("empty: the directory holds no PNG or TIFF file"));
}

TEST_F(ReadImagesTest, sections_of_another_size_or_type_are_named_with_both) {
    const fs::path folder = copy_of("png/gray8");
    fs::copy_file(data("png/gray16/s2.png"), folder / "s2.png", fs::copy_options::overwrite_existing);
    EXPECT_THAT(refusal({folder}),
                HasSubstr("s2.png: section 1: the image is 5 x 4 uint16 where section 0 is 5 x 4 uint8"));
    fs::copy_file(data("png/palette8/s2.png"), folder / "s2.png", fs::copy_options::overwrite_existing);
    EXPECT_THAT(refusal({folder}), HasSubstr("5 x 4 uint8 palette where section 0 is 5 x 4 uint8"));
    const fs::path other = data("tiff/tiles_uint16.tif");
    EXPECT_THAT(refusal({data("tiff/sections/s1.tif"), other}), HasSubstr("section 1: the file has 3 pages"));
}

TEST_F(ReadImagesTest, section_that_changes_after_opening_is_refused) {
    const fs::path folder = copy_of("png/gray8");
    const auto reader = open_sections({folder});
    fs::copy_file(data("png/gray16/s10.png"), folder / "s10.png", fs::copy_options::overwrite_existing);
    EXPECT_THROW(pull(*reader), Error);
}

TEST_F(ReadImagesTest, images_are_swept_along_z_only) {
    EXPECT_THAT(refusal({data("png/gray8")}, swept(SweepChoice::kY)),
                HasSubstr("cannot be read along y, only along z; give --sweep z"));
}

TEST_F(ReadImagesTest, png_cut_or_changed_anywhere_is_refused_or_read_and_nothing_is_printed) {
    for (const char* kind : {"gray8", "palette2", "interlaced_rgb8"}) {
        const std::string whole = text_of(data(std::string("png/") + kind + "/s1.png"));
        testing::internal::CaptureStderr();
        for (std::size_t length = 0; length < whole.size(); ++length) {
            put_text(path("a.png"), whole.substr(0, length));
            EXPECT_THAT(refusal({path("a.png")}), HasSubstr("a.png: section 0: ")) << length;
            std::string changed = whole;
            changed[length] ^= 0x55;
            put_text(path("a.png"), changed);
            refusal({path("a.png")});
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
}

TEST_F(ReadImagesTest, png_with_a_wrong_check_sum_is_damaged) {
    std::string bytes = text_of(data("png/gray8/s1.png"));
    bytes[bytes.find("IDAT") + 8] ^= 1;
    put_text(path("a.png"), bytes);
    EXPECT_THAT(refusal({path("a.png")}), HasSubstr("a.png: section 0: the PNG file is damaged ("));
}

TEST_F(ReadImagesTest, png_size_that_the_file_cannot_back_is_refused_before_anything_is_allocated) {
    std::string bytes = text_of(data("png/gray8/s1.png"));
    bytes.replace(16, 8, std::string("\x00\x00\x40\x00\x00\x00\x40\x00", 8));  // width and height
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);
    for (int i = 0; i < 4; ++i) bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
    put_text(path("big.png"), bytes);
    EXPECT_THAT(refusal({path("big.png")}), HasSubstr("bytes cannot hold that many pixels"));
}

TEST_F(ReadImagesTest, list_with_other_files_is_refused) {
    const fs::path image = data("png/gray8/s1.png");
    EXPECT_THAT(refusal({image, data("npy/uint8.npy")}), HasSubstr("uint8.npy: section 1: is no PNG or TIFF section"));
    EXPECT_THAT(refusal({image, path("missing.png")}), HasSubstr("missing.png: no such file"));
    fs::create_directory(path("folder.png"));
    EXPECT_THAT(refusal({image, path("folder.png")}), HasSubstr("is a directory where a file is expected"));
}

}  // namespace
}  // namespace regionmesh
