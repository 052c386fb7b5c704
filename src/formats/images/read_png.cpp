// PNG files, by libpng.
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "formats/array/volume_size.h"
#include "formats/images/image_formats.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

/// The state of calls that libpng may leave by longjmp: plain data, so that no destructor is skipped.
struct PngCall {
    const std::byte* bytes = nullptr;  // the file
    std::size_t size = 0;
    std::size_t at = 0;
    png_structp png = nullptr;
    png_infop png_info = nullptr;
    ImageShape shape;
    std::size_t row_bytes = 0;
    std::byte* pixels = nullptr;
    std::jmp_buf escape;
    char message[256] = "";
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
    auto* call = static_cast<PngCall*>(png_get_error_ptr(png));
    std::snprintf(call->message, sizeof call->message, "%s", text);
    std::longjmp(call->escape, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
    auto* call = static_cast<PngCall*>(png_get_io_ptr(png));
    if (call->size - call->at < count) png_error(png, "the file ends early");
    std::memcpy(out, call->bytes + call->at, count);
    call->at += count;
}

bool call_header(PngCall* call) {
    if (setjmp(call->escape)) return false;
    png_set_read_fn(call->png, call, read_bytes);
    png_read_info(call->png, call->png_info);
    call->shape.width = png_get_image_width(call->png, call->png_info);
    call->shape.height = png_get_image_height(call->png, call->png_info);
    call->shape.channels = png_get_channels(call->png, call->png_info);
    call->shape.bits = png_get_bit_depth(call->png, call->png_info);
    call->shape.is_palette = png_get_color_type(call->png, call->png_info) == PNG_COLOR_TYPE_PALETTE;
    call->row_bytes = png_get_rowbytes(call->png, call->png_info);
    return true;
}

/// Calls on_row(y) with each row, in their order. Interlaced images come in several passes over all rows, which are
/// held.
template <class OnRow>
bool call_pixels(PngCall* call, OnRow& on_row) {
    if (setjmp(call->escape)) return false;
    const int passes = png_set_interlace_handling(call->png);
    png_start_read_image(call->png);
    const std::size_t step = passes > 1 ? call->row_bytes : 0;
    for (int pass = 0; pass < passes; ++pass) {
        for (std::uint32_t y = 0; y < call->shape.height; ++y) {
            png_read_row(call->png, reinterpret_cast<png_bytep>(call->pixels + y * step), nullptr);
            if (pass + 1 == passes) on_row(y, call->pixels + y * step);
        }
    }
    png_read_end(call->png, nullptr);
    return true;
}

class PngImage {
public:
    PngImage(const std::filesystem::path& path, std::uint64_t section) : path_(path), section_(section) {
        const InputFile file(path);
        bytes_.resize(file.size());
        bytes_.resize(file.read(0, bytes_));
        call_.bytes = bytes_.data();
        call_.size = bytes_.size();
        if (bytes_.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes_.data()), 0, 8) != 0) {
            fail_section(path_, section_, "not a PNG file (it does not begin as one); check the file");
        }
        call_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &call_, on_error, ignore_warning);
        if (call_.png) call_.png_info = png_create_info_struct(call_.png);
        if (!call_.png_info) {
            png_destroy_read_struct(&call_.png, nullptr, nullptr);
            throw std::bad_alloc();
        }
        if (!call_header(&call_)) {
            png_destroy_read_struct(&call_.png, &call_.png_info, nullptr);
            refuse();
        }
    }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    ~PngImage() { png_destroy_read_struct(&call_.png, &call_.png_info, nullptr); }

    const ImageShape& shape() const { return call_.shape; }

    /// A header must not claim more pixels than the file can inflate to.
    void check_backing() {
        if (std::uint64_t{call_.row_bytes} * shape().height / kMaxInflation <= bytes_.size()) return;
        std::snprintf(call_.message, sizeof call_.message, "%zu bytes cannot hold that many pixels", bytes_.size());
        refuse();
    }

    void read(std::span<InputLabel> labels) {
        const bool is_interlaced = png_get_interlace_type(call_.png, call_.png_info) != PNG_INTERLACE_NONE;
        std::vector<std::byte> pixels(std::uint64_t{call_.row_bytes} * (is_interlaced ? shape().height : 1));
        call_.pixels = pixels.data();
        std::fill(labels.begin(), labels.end(), 0);
        const RowFormat format{.channel_count = shape().channels, .is_big_endian = true};
        const auto put_row = [&](std::size_t y, const std::byte* row) {
            unpack_row(std::span(row, call_.row_bytes), shape(), format,
                       labels.subspan(y * shape().width, shape().width));
        };
        if (!call_pixels(&call_, put_row)) refuse();
    }

private:
    [[noreturn]] void refuse() const {
        fail_section(path_, section_, std::string("the PNG file is damaged (") + call_.message + "); write it again");
    }

    const std::filesystem::path& path_;
    std::uint64_t section_;
    std::vector<std::byte> bytes_;
    PngCall call_;
};

}  // namespace

ImageShape read_png_shape(const std::filesystem::path& path, std::uint64_t section) {
    PngImage image(path, section);
    check_shape(path, section, image.shape());
    image.check_backing();
    return image.shape();
}

void read_png_image(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
                    std::span<InputLabel> labels) {
    PngImage image(path, section);
    check_same_shape(path, section, image.shape(), expected);
    image.check_backing();
    image.read(labels);
}

}  // namespace regionmesh::formats
