// A TIFF file and its pages, by libtiff.
#pragma once

#include <tiffio.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/images/image_shape.h"

namespace regionmesh::formats {

/// An open file. Messages of libtiff become part of an Error, and nothing is printed. Errors always count; warnings
/// count only while pixels are decoded, where they mean damage: in directories most concern tags that are not needed.
class TiffFile {
public:
    /// Lists the pages, except for smaller copies of others (previews). `section` is for error messages.
    explicit TiffFile(const std::filesystem::path& path, std::uint64_t section = 0);

    std::uint32_t page_count() const { return static_cast<std::uint32_t>(pages_.size()); }
    bool is_big_endian() const { return TIFFIsBigEndian(tiff_.get()) != 0; }

    /// Selects a page and returns its shape. `section` is for error messages.
    ImageShape read_shape(std::uint32_t page, std::uint64_t section);

    /// The tag ImageDescription of the selected page; often empty.
    std::string description() const;

    /// Pixels per unit along x and y of the selected page; 0 without such tags.
    std::array<double, 2> resolution() const;

    /// The offset of the pixels of the selected page, if they are neither compressed nor in tiles.
    std::optional<std::uint64_t> bare_offset() const;

    /// The tag Orientation of the selected page: 1 where rows begin at the top and columns at the left, 2 to 8 where
    /// pages are turned or mirrored while they are read.
    int orientation() const;

    /// Whether the selected page is stored in tiles, and not turned.
    bool is_tiled() const { return TIFFIsTiled(tiff_.get()) != 0 && orientation() == 1; }

    /// What of a page is read: a window of an image with this shape.
    struct Wanted {
        const ImageShape& shape;
        ImageWindow window;
    };
    static Wanted all_of(const ImageShape& shape) { return {shape, {{0, 0}, {shape.width, shape.height}}}; }

    /// Labels of a page, rows from the top. Reads the strips and tiles that meet the window. Throws if the shape of the
    /// page is not the wanted one.
    void read_page(std::uint32_t page, std::uint64_t section, const Wanted& wanted, std::span<InputLabel> labels);

private:
    struct Messages {
        bool is_decoding = false;
        bool has_short_list = false;    // of the offsets or sizes of strips or tiles, on any page
        std::array<char, 256> first{};  // empty without an error
    };
    struct Close {
        void operator()(TIFF* tiff) const { TIFFClose(tiff); }
    };
    struct Blocks;
    struct Block;

    static int on_error(TIFF*, void* messages, const char*, const char* format, va_list values);
    static int on_warning(TIFF*, void* messages, const char*, const char* format, va_list values);
    [[noreturn]] void refuse(std::uint64_t section, const std::string& otherwise) const;
    void list_pages(std::uint64_t section);
    void select(std::uint32_t page, std::uint64_t section);
    void check_pixels(std::uint64_t section) const;
    bool can_hold(std::uint64_t bytes) const;
    void check_backing(const ImageShape& shape, std::uint64_t section) const;
    ImageShape stored_shape(std::uint64_t section) const;
    void read_stored(std::uint64_t section, const Wanted& wanted, std::span<InputLabel> labels);
    Blocks blocks(const ImageShape& shape, std::uint64_t section) const;
    void check_sum(const Blocks& blocks, std::uint32_t number, std::uint64_t section) const;
    void decode(const Blocks& blocks, Block block, std::uint64_t section, std::span<std::byte> pixels);

    std::filesystem::path path_;
    std::uint64_t size_ = 0;
    std::unique_ptr<Messages> messages_;  // libtiff keeps its address
    std::unique_ptr<TIFF, Close> tiff_;
    std::vector<std::uint64_t> pages_;  // offsets of their directories
};

}  // namespace regionmesh::formats
