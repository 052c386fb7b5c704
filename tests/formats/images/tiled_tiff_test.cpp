// Boxes of TIFF files in tiles: one file of many pages, or a file a section.
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstdio>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 53, kHeight = 38, kPages = 4, kTile = 16;

/// What pixels are, and how they are stored.
struct Pixels {
    int bits = 16, channels = 1;
    bool are_planes = false;  // a plane for each channel
    bool is_tiled = true;
    int compression = COMPRESSION_ADOBE_DEFLATE;
    bool has_holes = false;  // the first tile or strip is not written
};

/// The next of the bytes that the pixels are made of.
std::uint8_t next_byte() {
    static std::uint32_t state = 1;
    state = state * 1664525 + 1013904223;
    return static_cast<std::uint8_t>(state >> 24);
}

void write_page(TIFF* tiff, const Pixels& pixels) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, pixels.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, pixels.channels);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, pixels.channels == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, pixels.are_planes ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, pixels.compression);
    if (pixels.is_tiled) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kTile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, kTile);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 5);
    }
    const std::uint32_t count = pixels.is_tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    for (std::uint32_t n = pixels.has_holes ? 1 : 0; n < count; ++n) {
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(
            pixels.is_tiled ? TIFFTileSize(tiff) : TIFFVStripSize(tiff, n + 1 < count ? 5 : 3)));
        for (std::uint8_t& byte : bytes) byte = next_byte();
        const auto size = static_cast<tmsize_t>(bytes.size());
        ASSERT_EQ(pixels.is_tiled ? TIFFWriteEncodedTile(tiff, n, bytes.data(), size)
                                  : TIFFWriteEncodedStrip(tiff, n, bytes.data(), size),
                  size);
    }
    ASSERT_TRUE(TIFFWriteDirectory(tiff));
}

void write_file(const fs::path& path, std::uint32_t pages, const Pixels& pixels) {
    TIFF* const tiff = TIFFOpen(path.c_str(), "w");
    ASSERT_TRUE(tiff);
    for (std::uint32_t page = 0; page < pages; ++page) write_page(tiff, pixels);
    TIFFClose(tiff);
}

void expect_boxes(const fs::path& source) {
    const auto first = open_sections({source});
    const Volume whole{first->info(), pull(*first)};
    ASSERT_EQ(whole.info.lattice.size, (std::array{kWidth, kHeight, kPages}));
    for (const IndexBox& box :
         {IndexBox{{0, 0, 0}, {kWidth, kHeight, kPages}}, IndexBox{{1, 2, 1}, {40, 30, 3}},
          IndexBox{{16, 16, 0}, {32, 32, 4}}, IndexBox{{17, 3, 2}, {52, 38, 4}}, IndexBox{{50, 37, 3}, {53, 38, 4}}}) {
        const auto part = open_sections({source});
        ASSERT_TRUE(part->crop(box));
        const auto size = box.size();
        ASSERT_EQ(part->info().lattice.size, size);
        const std::vector<InputLabel> labels = pull(*part);
        std::size_t n = 0;
        for (std::uint32_t z = box.low[2]; z < box.high[2]; ++z)
            for (std::uint32_t y = box.low[1]; y < box.high[1]; ++y)
                for (std::uint32_t x = box.low[0]; x < box.high[0]; ++x)
                    ASSERT_EQ(labels[n++], whole.labels[(std::size_t{z} * kHeight + y) * kWidth + x])
                        << x << ' ' << y << ' ' << z;
    }
}

class TiledTiff : public TemporaryFolder {};

TEST_F(TiledTiff, boxes_have_the_labels_of_the_whole) {
    for (const Pixels& pixels :
         {Pixels{.bits = 1}, Pixels{.bits = 4}, Pixels{.bits = 8}, Pixels{.bits = 16}, Pixels{.bits = 64},
          Pixels{.bits = 8, .channels = 3}, Pixels{.bits = 16, .channels = 3, .are_planes = true}}) {
        SCOPED_TRACE(std::to_string(pixels.bits) + " bits, " + std::to_string(pixels.channels) + " channels");
        write_file(path("pages.tif"), kPages, pixels);
        expect_boxes(path("pages.tif"));
        fs::create_directory(path("sections"));
        for (std::uint32_t page = 0; page < kPages; ++page)
            write_file(path("sections/" + std::to_string(page) + ".tif"), 1, pixels);
        expect_boxes(path("sections"));
    }
}

TEST_F(TiledTiff, a_box_is_read_from_the_tiles_that_it_meets) {
    write_file(path("pages.tif"), kPages, {});
    std::string bytes = text_of(path("pages.tif"));
    TIFF* const tiff = TIFFOpen(path("pages.tif").c_str(), "r");
    const auto last = static_cast<std::size_t>(TIFFGetStrileOffset(tiff, TIFFNumberOfTiles(tiff) - 1));
    TIFFClose(tiff);
    for (std::size_t n = 2; n < 20; ++n) bytes[last + n] = '\xff';  // the tile at the last corner of the first page
    put_text(path("pages.tif"), bytes);
    EXPECT_THROW(pull(*open_sections({path("pages.tif")})), Error);
    const auto part = open_sections({path("pages.tif")});
    ASSERT_TRUE(part->crop({{0, 0, 0}, {kWidth, 32, kPages}}));
    EXPECT_EQ(pull(*part).size(), std::size_t{kWidth} * 32 * kPages);
}

TEST_F(TiledTiff, blocks_without_their_checksum_are_refused) {
    for (const bool is_tiled : {true, false}) {
        write_file(path("a.tif"), 1, {.is_tiled = is_tiled});
        EXPECT_NO_THROW(read_volume({path("a.tif")}));
        TIFF* const tiff = TIFFOpen(path("a.tif").c_str(), "r");
        ASSERT_TRUE(tiff);
        const std::uint64_t end = TIFFGetStrileOffset(tiff, 0) + TIFFGetStrileByteCount(tiff, 0);
        TIFFClose(tiff);
        std::string bytes = text_of(path("a.tif"));
        bytes[end - 1] ^= 1;  // of Adler-32, behind the pixels
        put_text(path("a.tif"), bytes);
        EXPECT_NE(refusal({path("a.tif")}).find("does not have its checksum"), std::string::npos);
    }
}

TEST_F(TiledTiff, blocks_that_were_never_written_are_zero) {
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE})
        for (const bool is_tiled : {true, false}) {
            SCOPED_TRACE(std::to_string(compression) + (is_tiled ? " tiles" : " strips"));
            write_file(path("a.tif"), kPages, {.is_tiled = is_tiled, .compression = compression, .has_holes = true});
            const std::uint32_t width = is_tiled ? kTile : kWidth, height = is_tiled ? kTile : 5;
            const std::vector<InputLabel> labels = read_volume({path("a.tif")}).labels;
            for (std::uint32_t z = 0; z < kPages; ++z) {
                std::uint32_t inside = 0, outside = 0;  // samples that are not 0
                for (std::uint32_t y = 0; y < kHeight; ++y)
                    for (std::uint32_t x = 0; x < kWidth; ++x)
                        (x < width && y < height ? inside : outside) +=
                            labels[(std::size_t{z} * kHeight + y) * kWidth + x] != 0;
                EXPECT_EQ(inside, 0u);
                EXPECT_GT(outside, 1000u);
            }
        }
}

TEST_F(TiledTiff, a_strip_with_fewer_bytes_than_its_pixels_is_refused) {
    write_file(path("a.tif"), 1, {.bits = 8, .is_tiled = false, .compression = COMPRESSION_NONE});
    std::string bytes = text_of(path("a.tif"));
    constexpr char kLow = kWidth * 5 % 256, kHigh = kWidth * 5 / 256;
    std::size_t counts = bytes.find({kLow, kHigh, kLow, kHigh, kLow, kHigh}), width = 2;
    if (counts == std::string::npos) {
        counts = bytes.find({kLow, kHigh, 0, 0, kLow, kHigh, 0, 0, kLow, kHigh, 0, 0});
        width = 4;
    }
    ASSERT_NE(counts, std::string::npos);
    EXPECT_NO_THROW(read_volume({path("a.tif")}));
    bytes[counts + 2 * width] -= 1;  // if the first differed from the second, libtiff would guess all of them
    put_text(path("a.tif"), bytes);
    EXPECT_NE(refusal({path("a.tif")}).find("section 0: the TIFF file is damaged (a strip or tile is cut short)"),
              std::string::npos);
}

TEST_F(TiledTiff, strips_that_the_file_does_not_list_are_refused) {
    for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE}) {
        write_file(path("a.tif"), 1, {.bits = 8, .is_tiled = false, .compression = compression});
        EXPECT_NO_THROW(read_volume({path("a.tif")}));
        std::string bytes = text_of(path("a.tif"));
        for (const char tag : {'\x11', '\x17'}) {  // StripOffsets and StripByteCounts
            const std::string counted = {8, 0, 0, 0};
            std::size_t entry = bytes.find({tag, 1});
            while (bytes.compare(entry + 4, 4, counted) != 0) entry = bytes.find({tag, 1}, entry + 1);
            bytes[entry + 4] = 4;
        }
        put_text(path("a.tif"), bytes);
        EXPECT_NE(refusal({path("a.tif")}).find("is damaged"), std::string::npos) << compression;
    }
}

TEST_F(TiledTiff, pages_that_are_no_sections_are_refused) {
    const auto with_tag = [&](std::uint32_t tag, const auto& value) {
        TIFF* const tiff = TIFFOpen(path("a.tif").c_str(), "w");
        for (std::uint32_t page = 0; page < kPages; ++page) {
            TIFFSetField(tiff, tag, value);
            write_page(tiff, {});
        }
        TIFFClose(tiff);
    };
    with_tag(TIFFTAG_IMAGEDESCRIPTION, R"(<?xml version="1.0"?><OME><Pixels SizeC="2" SizeT="1" SizeZ="2"/></OME>)");
    EXPECT_NE(refusal({path("a.tif")}).find("has 2 channels; choose one with --layer 0 to 1"), std::string::npos);
    with_tag(TIFFTAG_IMAGEDESCRIPTION, R"(<?xml version="1.0"?><OME><Pixels SizeC="1" SizeT="1" SizeZ="4"/></OME>)");
    EXPECT_NO_THROW(read_volume({path("a.tif")}));
    with_tag(TIFFTAG_IMAGEDESCRIPTION, R"(<?xml version="1.0"?><OME><Pixels SizeC="1" SizeT="4" SizeZ="1"/></OME>)");
    EXPECT_NO_THROW(read_volume({path("a.tif")})) << "sections stored as times, as from ImageJ";
    with_tag(TIFFTAG_IMAGEDESCRIPTION, R"(<?xml version="1.0"?><OME><Pixels SizeC="2" SizeT="1" SizeZ="4"/></OME>)");
    EXPECT_NO_THROW(read_volume({path("a.tif")})) << "the other channel is in another file";
    with_tag(TIFFTAG_IMAGEDESCRIPTION, R"({"shape": [2, 2, 38, 53]})");
    EXPECT_NE(refusal({path("a.tif")}).find("has 2 volumes; choose one with --layer 0 to 1"), std::string::npos);
    with_tag(TIFFTAG_IMAGEDESCRIPTION, R"({"shape": [1, 4, 38, 53]})");
    EXPECT_NO_THROW(read_volume({path("a.tif")}));
    with_tag(TIFFTAG_IMAGEDEPTH, std::uint32_t{7});
    EXPECT_NE(refusal({path("a.tif")}).find("the page is a volume of 7 sections"), std::string::npos);
}

TEST_F(TiledTiff, strips_are_not_read_in_boxes) {
    write_file(path("pages.tif"), kPages, {.is_tiled = false});
    EXPECT_FALSE(open_sections({path("pages.tif")})->crop({{1, 1, 1}, {5, 5, 2}}));
    fs::create_directory(path("sections"));
    for (std::uint32_t page = 0; page < 2; ++page)  // the first file decides; the labels are right in any case
        write_file(path("sections/" + std::to_string(page) + ".tif"), 1, {.is_tiled = page == 1});
    EXPECT_FALSE(open_sections({path("sections")})->crop({{1, 1, 0}, {5, 5, 2}}));
}

}  // namespace
}  // namespace regionmesh
