// Raster tessellations of Neper: https://neper.info/doc/exprs_fileformat.html
#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "formats/array/array_file.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/byte_reader.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

std::string word_after(ByteReader& file, const char* what) {
    const auto word = file.take_word();
    if (!word) file.fail(fmt::format("ends before its {}; it is truncated, fetch it again", what));
    return std::string(*word);
}

/// `**general`: dimension, samples and their sizes, and perhaps the origin.
void read_general(ByteReader& file, const ReadOptions& options, ArrayFile& array) {
    if (!file.skip_past("**general")) file.fail("has no section **general; write the file again");
    const auto dimension = parse_size(word_after(file, "dimension"));
    if (!dimension || *dimension < 2 || *dimension > 3) file.fail_line("the dimension is neither 2 nor 3");
    std::array<std::uint64_t, 3> size{1, 1, 1};
    for (std::size_t axis = 0; axis < *dimension; ++axis) {
        const std::string word = word_after(file, "size");
        const auto count = parse_size(word);
        if (!count) file.fail_line(fmt::format("the size is '{}', no whole number", shown(word)));
        size[axis] = *count;
    }
    array.lattice.size = checked_size(file.path(), size);
    Vec3 origin{0, 0, 0};
    for (std::size_t axis = 0; axis < *dimension; ++axis) {
        const std::string word = word_after(file, "voxel size");
        const auto length = parse_finite(word);
        if (!length || !(*length > 0))
            file.fail_line(fmt::format("the voxel size is '{}'; write the file again", shown(word)));
        array.lattice.spacing[static_cast<int>(axis)] = *length;
    }
    if (*dimension == 2) array.lattice.spacing.z = array.lattice.spacing.x;
    std::string word = word_after(file, "cells");
    if (word == "*origin") {
        for (std::size_t axis = 0; axis < *dimension; ++axis) {
            const auto place = parse_finite(word_after(file, "origin"));
            if (!place) file.fail_line("the origin is no number; write the file again");
            origin[static_cast<int>(axis)] = *place;
        }
    }
    // A sample lies in the middle of its voxel.
    for (int axis = 0; axis < 3; ++axis)
        array.lattice.origin[axis] =
            origin[axis] + (options.spacing ? *options.spacing : array.lattice.spacing)[axis] / 2;
}

/// `**data`: how labels are stored, then the labels, or the file that has them.
void read_data(ByteReader& file, ArrayFile& array) {
    if (!file.skip_past("**data")) file.fail("has no section **data; write the file again");
    static const std::map<std::string, SampleFormat, std::less<>> kFormats{
        {"ascii", {.type = SampleType::kI32}},    {"binary8", {.type = SampleType::kU8}},
        {"binary16", {.type = SampleType::kI16}}, {"binary16_big", {.type = SampleType::kI16, .is_big_endian = true}},
        {"binary32", {.type = SampleType::kI32}}, {"binary32_big", {.type = SampleType::kI32, .is_big_endian = true}}};
    const std::string word = word_after(file, "data");
    const auto format = kFormats.find(word);
    if (format == kFormats.end())
        file.fail_line(fmt::format("data are '{}'; write them as ascii, binary8, binary16 or binary32", shown(word)));
    array.sample = format->second;
    array.encoding = word == "ascii" ? Encoding::kAscii : Encoding::kRaw;
    file.take_line();
    array.begin = file.place();
    if (file.left() >= 6 && trim(file.peek(std::min<std::uint64_t>(file.left(), 64))).starts_with("*file")) {
        file.take_word();
        array.files = {file_beside(array.source, word_after(file, "name of the file of data"))};
        array.begin = 0;
    } else if (array.encoding == Encoding::kAscii) {
        if (!file.skip_past("**")) file.fail("ends before its line ***end; it is truncated, fetch it again");
        array.end = file.place() - 2;
    }
}

}  // namespace

std::unique_ptr<SectionReader> open_tesr(const fs::path& path, const ReadOptions& options) {
    ArrayFile array{.format = "tesr", .source = path};
    ByteReader file(path);
    if (file.left() < 7 || file.peek(7) != "***tesr") fail(path, "not a .tesr file (it does not begin as one)");
    read_general(file, options, array);
    read_data(file, array);
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
