#include "formats/images/tiff_file.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <utility>

#include "formats/array/volume_size.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kMaxBlockBytes = std::uint64_t{1} << 30;
constexpr int kFirstTransposed = 5;  // of the values of the tag Orientation: from here on rows are columns

/// Where the pixel of a turned page lies in the stored one, by the tag Orientation.
struct Turn {
    int orientation;
    std::uint32_t width, height;  // as stored

    std::size_t operator()(std::uint32_t column, std::uint32_t row) const {
        if (orientation >= kFirstTransposed) std::swap(column, row);
        constexpr std::array kFromRight{false, true, true, false, false, false, true, true};
        constexpr std::array kFromBottom{false, false, true, true, false, true, true, false};
        const auto n = static_cast<std::size_t>(orientation - 1);
        if (kFromRight[n]) column = width - 1 - column;
        if (kFromBottom[n]) row = height - 1 - row;
        return std::size_t{row} * width + column;
    }
};

/// Most bytes that one byte of the file unpacks to. A packbits pair gives 128; an LZW code of nine bits or more, 4096.
constexpr std::array<std::pair<int, std::uint64_t>, 5> kExpansions{{{COMPRESSION_NONE, 1},
                                                                    {COMPRESSION_PACKBITS, 64},
                                                                    {COMPRESSION_ADOBE_DEFLATE, kMaxInflation},
                                                                    {COMPRESSION_DEFLATE, kMaxInflation},
                                                                    {COMPRESSION_LZW, 4096}}};

void keep_first(std::array<char, 256>& first, const char* format, va_list values) {
    if (first[0] != '\0') return;
    std::vsnprintf(first.data(), first.size(), format, values);
    if (first[0] == '\0') first[0] = '?';
}

template <class Value>
Value tag(TIFF* tiff, std::uint32_t name, Value otherwise) {
    Value value = otherwise;
    return TIFFGetFieldDefaulted(tiff, name, &value) == 1 ? value : otherwise;
}

/// Are these the bytes of a whole zlib stream (RFC 1950)? It may inflate to more than its block needs, as padded strips
/// do, but not to a multiple that takes long.
bool has_checksum(std::span<std::byte> packed, std::uint64_t needed) {
    constexpr std::uint64_t kMostPadding = 16;
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());  // at most kMaxBlockBytes
    std::array<Bytef, 1 << 15> plain;
    int result = Z_OK;
    while (result == Z_OK && stream.total_out <= kMostPadding * needed) {
        stream.next_out = plain.data();
        stream.avail_out = static_cast<uInt>(plain.size());
        result = inflate(&stream, Z_NO_FLUSH);
    }
    inflateEnd(&stream);
    return result == Z_STREAM_END;
}

}  // namespace

/// The parts in which pixels are decoded: strips or tiles.
struct TiffFile::Blocks {
    bool are_tiles;
    std::uint32_t width, height;  // of one, in pixels
    std::uint64_t row_bytes;
    std::uint64_t bytes;
    int planes;  // 1: the channels of a pixel are adjacent
};

struct TiffFile::Block {
    std::uint16_t plane;
    std::uint32_t left, top;
};

int TiffFile::on_error(TIFF*, void* messages, const char*, const char* format, va_list values) {
    keep_first(static_cast<Messages*>(messages)->first, format, values);
    return 1;
}

int TiffFile::on_warning(TIFF*, void* messages, const char* function, const char* format, va_list values) {
    auto* kept = static_cast<Messages*>(messages);
    // This function of libtiff fills up a list of offsets that is too short, with 0.
    if (function && std::string_view(function) == "TIFFFetchStripThing") kept->has_short_list = true;
    if (kept->is_decoding) keep_first(kept->first, format, values);
    return 1;
}

void TiffFile::refuse(std::uint64_t section, const std::string& otherwise) const {
    const char* message = messages_->first.data();
    fail_section(path_, section, "the TIFF file is damaged (" + (*message ? message : otherwise) + "); write it again");
}

TiffFile::TiffFile(const std::filesystem::path& path, std::uint64_t section)
    : path_(path), messages_(std::make_unique<Messages>()) {
    size_ = InputFile(path).size();
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, messages_.get());
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, messages_.get());
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(kMaxBlockBytes));
    // "m": not mapped into memory, where a file cut short while it is read would end the program.
    tiff_.reset(TIFFOpenExt(path.c_str(), "rm", options.get()));
    if (!tiff_) refuse(section, "no TIFF header");
    list_pages(section);
}

void TiffFile::list_pages(std::uint64_t section) {
    while (true) {
        if (!(tag<std::uint32_t>(tiff_.get(), TIFFTAG_SUBFILETYPE, 0) & FILETYPE_REDUCEDIMAGE)) {
            pages_.push_back(TIFFCurrentDirOffset(tiff_.get()));
        }
        if (TIFFLastDirectory(tiff_.get())) break;
        if (!TIFFReadDirectory(tiff_.get())) refuse(section + pages_.size(), "a page has no directory");
    }
    if (pages_.empty() || messages_->first[0]) refuse(section, "no page");
}

void TiffFile::select(std::uint32_t page, std::uint64_t section) {
    *messages_ = {.has_short_list = messages_->has_short_list};
    if (TIFFCurrentDirOffset(tiff_.get()) == pages_[page]) return;
    if (!TIFFSetSubDirectory(tiff_.get(), pages_[page]) || messages_->first[0])
        refuse(section, "a page has no directory");
}

/// Refuses pixels that are no labels: reals, and colour models of lossy codecs.
void TiffFile::check_pixels(std::uint64_t section) const {
    TIFF* tiff = tiff_.get();
    const auto format = tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    const char* what = nullptr;
    if (format == SAMPLEFORMAT_COMPLEXINT || format == SAMPLEFORMAT_COMPLEXIEEEFP) what = "complex";
    if (what)
        fail_section(path_, section,
                     std::string("samples are ") + what + "; labels must be integers: convert to 16 or 32 bit");
    const auto colours = tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    constexpr std::array kRead{PHOTOMETRIC_MINISWHITE, PHOTOMETRIC_MINISBLACK, PHOTOMETRIC_RGB, PHOTOMETRIC_PALETTE,
                               PHOTOMETRIC_MASK};
    if (std::find(kRead.begin(), kRead.end(), colours) == kRead.end()) {
        fail_section(path_, section,
                     "colours are coded in a way that is not read (PhotometricInterpretation " +
                         std::to_string(colours) + "); convert to gray or RGB without loss");
    }
}

/// Whether the file can unpack to `bytes`. For codecs that kExpansions lacks, any ratio up to 2^32 is allowed.
bool TiffFile::can_hold(std::uint64_t bytes) const {
    std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const auto compression = tag<std::uint16_t>(tiff_.get(), TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    for (const auto& [code, expansion] : kExpansions) {
        if (code == compression) most = expansion;
    }
    return bytes / most <= size_;
}

/// A header must not claim more pixels than the file can unpack to.
void TiffFile::check_backing(const ImageShape& shape, std::uint64_t section) const {
    const std::uint64_t row_bytes = (std::uint64_t{shape.width} * shape.channels * shape.bits + 7) / 8;
    if (can_hold(row_bytes * shape.height)) return;
    fail_section(path_, section,
                 "the image is " + describe(shape) + ", more than a file of " + std::to_string(size_) +
                     " bytes can hold; the file is truncated or damaged, fetch it again");
}

int TiffFile::orientation() const {
    const auto found = tag<std::uint16_t>(tiff_.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    return found >= 1 && found <= 8 ? found : 1;
}

ImageShape TiffFile::read_shape(std::uint32_t page, std::uint64_t section) {
    select(page, section);
    check_pixels(section);
    ImageShape shape = stored_shape(section);
    if (orientation() >= kFirstTransposed) std::swap(shape.width, shape.height);
    return shape;
}

/// Of the selected page, before it is turned.
ImageShape TiffFile::stored_shape(std::uint64_t section) const {
    TIFF* tiff = tiff_.get();
    if (const auto depth = tag<std::uint32_t>(tiff, TIFFTAG_IMAGEDEPTH, 1); depth > 1)
        fail_section(path_, section,
                     "the page is a volume of " + std::to_string(depth) + " sections; save each section as a page");
    const ImageShape shape{
        .width = tag<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0),
        .height = tag<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0),
        .channels = tag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1),
        .bits = tag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1),
        .is_signed = tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) == SAMPLEFORMAT_INT,
        .is_palette = tag<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) == PHOTOMETRIC_PALETTE,
        .is_real = tag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) == SAMPLEFORMAT_IEEEFP};
    check_shape(path_, section, shape);
    check_backing(shape, section);
    return shape;
}

std::string TiffFile::description() const {
    const char* text = nullptr;
    return TIFFGetField(tiff_.get(), TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text ? text : "";
}

std::array<double, 2> TiffFile::resolution() const {
    return {tag<float>(tiff_.get(), TIFFTAG_XRESOLUTION, 0), tag<float>(tiff_.get(), TIFFTAG_YRESOLUTION, 0)};
}

std::optional<std::uint64_t> TiffFile::bare_offset() const {
    if (TIFFIsTiled(tiff_.get()) || orientation() != 1 ||
        tag<std::uint16_t>(tiff_.get(), TIFFTAG_COMPRESSION, COMPRESSION_NONE) != COMPRESSION_NONE) {
        return std::nullopt;
    }
    return TIFFGetStrileOffset(tiff_.get(), 0);
}

TiffFile::Blocks TiffFile::blocks(const ImageShape& shape, std::uint64_t section) const {
    TIFF* tiff = tiff_.get();
    Blocks blocks{.are_tiles = TIFFIsTiled(tiff) != 0,
                  .width = shape.width,
                  .height = shape.height,
                  .row_bytes = 0,
                  .bytes = 0,
                  .planes = 1};
    if (tag<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE)
        blocks.planes = shape.channels;
    if (blocks.are_tiles) {
        blocks.width = tag<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0);
        blocks.height = tag<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
        blocks.row_bytes = TIFFTileRowSize64(tiff);
    } else {
        blocks.height = std::min(shape.height, tag<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, shape.height));
        blocks.row_bytes = TIFFScanlineSize64(tiff);
    }
    const std::uint64_t bits = std::uint64_t{blocks.width} * shape.bits * (blocks.planes == 1 ? shape.channels : 1);
    if (bits == 0 || blocks.height == 0 || blocks.row_bytes < (bits + 7) / 8)
        refuse(section, "strips or tiles without size");
    if (blocks.row_bytes > kMaxBlockBytes / blocks.height) {
        fail_section(path_, section, "one strip or tile takes more than 1 GiB; save it with smaller ones");
    }
    blocks.bytes = blocks.row_bytes * blocks.height;
    if (!can_hold(blocks.bytes)) refuse(section, "a strip or tile is larger than the file can hold");
    return blocks;
}

/// Of a deflated strip or tile: libtiff does not look at it.
void TiffFile::check_sum(const Blocks& blocks, std::uint32_t number, std::uint64_t section) const {
    TIFF* tiff = tiff_.get();
    const auto compression = tag<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    if (compression != COMPRESSION_ADOBE_DEFLATE && compression != COMPRESSION_DEFLATE) return;
    if (tag<std::uint16_t>(tiff, TIFFTAG_FILLORDER, FILLORDER_MSB2LSB) != FILLORDER_MSB2LSB) return;
    std::vector<std::byte> packed(std::min({TIFFGetStrileByteCount(tiff, number), size_, kMaxBlockBytes}));
    const auto size = static_cast<tmsize_t>(packed.size());
    const tmsize_t read = blocks.are_tiles ? TIFFReadRawTile(tiff, number, packed.data(), size)
                                           : TIFFReadRawStrip(tiff, number, packed.data(), size);
    if (read != size) refuse(section, "a strip or tile is cut short");
    if (!has_checksum(packed, blocks.bytes)) refuse(section, "a deflated strip or tile does not have its checksum");
}

void TiffFile::decode(const Blocks& blocks, Block block, std::uint64_t section, std::span<std::byte> pixels) {
    TIFF* tiff = tiff_.get();
    const std::uint32_t number = blocks.are_tiles ? TIFFComputeTile(tiff, block.left, block.top, 0, block.plane)
                                                  : TIFFComputeStrip(tiff, block.top, block.plane);
    const std::uint64_t stored = TIFFGetStrileByteCount(tiff, number);
    // Never written: GDAL leaves out blocks of nothing but 0.
    if (stored == 0 && TIFFGetStrileOffset(tiff, number) == 0 && !messages_->has_short_list) {
        std::ranges::fill(pixels, std::byte{});
        return;
    }
    // libtiff reads what is not compressed without a look at its size. Where it finds sizes wrong, it guesses them.
    if (stored < pixels.size() && tag<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_NONE)
        refuse(section, "a strip or tile is cut short");
    check_sum(blocks, number, section);
    const auto wanted = static_cast<tmsize_t>(pixels.size());
    const tmsize_t count = blocks.are_tiles ? TIFFReadEncodedTile(tiff, number, pixels.data(), wanted)
                                            : TIFFReadEncodedStrip(tiff, number, pixels.data(), wanted);
    if (count < wanted || messages_->first[0]) refuse(section, "a strip or tile is cut short");
}

/// Unpacks rows of strips and tiles to the labels of a window.
class WindowRows {
public:
    WindowRows(const ImageShape& shape, const ImageWindow& window, std::span<InputLabel> labels)
        : shape_(shape), window_(window), labels_(labels) {
        std::ranges::fill(labels, 0);
    }

    bool has_row(std::uint32_t row) const { return window_.low[1] <= row && row < window_.high[1]; }
    /// A row of the window whose pixels begin at column `left` of the image and are `columns`.
    std::optional<NoLabel> unpack(std::span<const std::byte> pixels, RowFormat format, std::uint32_t row,
                                  std::array<std::uint32_t, 2> columns) {
        const auto [left, right] = columns;
        const std::uint32_t low = std::max(left, window_.low[0]), high = std::min(right, window_.high[0]);
        const auto wanted =
            labels_.subspan(std::size_t{row - window_.low[1]} * window_.width() + (low - window_.low[0]), high - low);
        if (low == left) return unpack_row(pixels, shape_, format, wanted);
        whole_.assign(high - left, 0);
        const auto part = std::span(whole_).subspan(low - left);
        std::ranges::copy(wanted, part.begin());  // channels are added to those there
        auto problem = unpack_row(pixels, shape_, format, whole_);
        std::ranges::copy(part, wanted.begin());
        return problem;
    }

private:
    const ImageShape& shape_;
    const ImageWindow& window_;
    std::span<InputLabel> labels_;
    std::vector<InputLabel> whole_;  // a row up to the window's end
};

void TiffFile::read_page(std::uint32_t page, std::uint64_t section, const Wanted& wanted,
                         std::span<InputLabel> labels) {
    check_same_shape(path_, section, read_shape(page, section), wanted.shape);
    const int turned = orientation();
    if (turned == 1) return read_stored(section, wanted, labels);
    const ImageShape stored = stored_shape(section);
    std::vector<InputLabel> whole(std::size_t{stored.width} * stored.height);
    read_stored(section, all_of(stored), whole);
    const Turn turn{turned, stored.width, stored.height};
    const auto& [low, high] = wanted.window;
    auto label = labels.begin();
    for (std::uint32_t row = low[1]; row < high[1]; ++row)
        for (std::uint32_t column = low[0]; column < high[0]; ++column) *label++ = whole[turn(column, row)];
}

/// Of the selected page, before it is turned.
void TiffFile::read_stored(std::uint64_t section, const Wanted& wanted, std::span<InputLabel> labels) {
    const auto& [shape, window] = wanted;
    const Blocks all = blocks(shape, section);
    std::vector<std::byte> pixels(all.bytes);
    WindowRows rows_of_window(shape, window, labels);
    messages_->is_decoding = true;
    // libtiff has converted wide samples to the byte order of this machine.
    RowFormat format{.channel_count = all.planes == 1 ? shape.channels : 1,
                     .is_big_endian = std::endian::native == std::endian::big};
    const auto read_block = [&](Block block) {
        const std::uint32_t columns = std::min(all.width, shape.width - block.left);
        const std::uint32_t rows = std::min(all.height, shape.height - block.top);
        decode(all, block, section, std::span(pixels).first(all.row_bytes * (all.are_tiles ? all.height : rows)));
        for (std::uint32_t row = 0; row < rows; ++row)
            if (rows_of_window.has_row(block.top + row))
                require_labels(path_, section,
                               rows_of_window.unpack(std::span(pixels).subspan(row * all.row_bytes, all.row_bytes),
                                                     format, block.top + row, {block.left, block.left + columns}),
                               block.left, block.top + row);
    };
    for (int plane = 0; plane < all.planes; ++plane) {
        format.first_channel = plane;
        for (std::uint64_t top = window.low[1] / all.height * all.height; top < window.high[1]; top += all.height) {
            for (std::uint64_t left = window.low[0] / all.width * all.width; left < window.high[0]; left += all.width) {
                read_block({static_cast<std::uint16_t>(plane), static_cast<std::uint32_t>(left),
                            static_cast<std::uint32_t>(top)});
            }
        }
    }
}

}  // namespace regionmesh::formats
