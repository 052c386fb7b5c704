// MetaImage, ITK's own format: https://itk.org/Wiki/ITK/MetaIO/Documentation
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "formats/array/affine.h"
#include "formats/array/array_file.h"
#include "formats/array/header_fields.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHeaderBytes = std::size_t{1} << 20;
constexpr std::string_view kDataFile = "ElementDataFile";  // the last key

/// MetaIO's long has four bytes, on every machine.
constexpr std::array<std::pair<std::string_view, SampleType>, 10> kTypes{{
    {"MET_CHAR", SampleType::kI8},
    {"MET_UCHAR", SampleType::kU8},
    {"MET_SHORT", SampleType::kI16},
    {"MET_USHORT", SampleType::kU16},
    {"MET_INT", SampleType::kI32},
    {"MET_UINT", SampleType::kU32},
    {"MET_LONG", SampleType::kI32},
    {"MET_ULONG", SampleType::kU32},
    {"MET_LONG_LONG", SampleType::kI64},
    {"MET_ULONG_LONG", SampleType::kU64},
}};

struct MetaHeader {
    HeaderFields fields;
    std::string behind = {};  // lines after the last key
    std::uint64_t end = 0;    // of the header
};

MetaHeader read_header(const InputFile& file) {
    MetaHeader header{HeaderFields(file.path())};
    std::string bytes(std::min<std::uint64_t>(file.size(), kMostHeaderBytes), '\0');
    bytes.resize(file.read(0, std::as_writable_bytes(std::span(bytes))));
    std::string_view rest = bytes;
    while (!rest.empty()) {
        const std::string_view line = take_line(rest);
        const std::size_t equals = std::min(line.find_first_of("=:"), line.size());
        const std::string_view key = trim(line.substr(0, equals));
        if (key.empty()) continue;
        if (equals == line.size()) {
            fail(file.path(),
                 fmt::format("line '{}' is no MetaImage header ('key = value'); check the file", shown(line)));
        }
        header.fields.add(key, line.substr(equals + 1));
        if (key != kDataFile) continue;
        if (header.fields.text({kDataFile}).empty()) break;
        header.end = bytes.size() - rest.size();
        if (header.fields.text({kDataFile}).starts_with("LIST")) header.behind = rest;
        return header;
    }
    fail(file.path(), "has no ElementDataFile at the end of its header; it is truncated or no MetaImage");
}

SampleFormat sample_format(const HeaderFields& header) {
    const std::string_view word = header.text({"ElementType"});
    const bool is_big_endian = header.flag({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
    if (word == "MET_FLOAT") return real_format(NumberType::kFloat32, is_big_endian);
    if (word == "MET_DOUBLE") return real_format(NumberType::kFloat64, is_big_endian);
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& entry) { return entry.first == word; });
    if (found == kTypes.end()) header.refuse("ElementType", "labels must be integers: convert them, to MET_INT say");
    return {found->second, is_big_endian};
}

std::vector<std::uint64_t> axis_sizes(const HeaderFields& header, std::size_t dimension) {
    auto sizes = parse_sizes(header.text({"DimSize"}));
    if (!sizes || sizes->size() != dimension) header.refuse("DimSize", "a count for each axis is needed");
    sizes->resize(std::max<std::size_t>(dimension, 3), 1);
    return *sizes;
}

/// Channels are the values of one sample.
void choose_volume(const std::vector<std::uint64_t>& sizes, std::int64_t channels, const ReadOptions& options,
                   ArrayFile& array) {
    std::vector<BlockAxis> axes;
    for (std::size_t axis = 3; axis < sizes.size(); ++axis)
        axes.push_back({fmt::format("axis {} of DimSize", axis + 1), sizes[axis]});
    if (channels > 1) {
        const bool is_alone = std::all_of(sizes.begin() + 3, sizes.end(), [](std::uint64_t size) { return size == 1; });
        if (!is_alone) fail(array.source, "has several channels at several times; save one volume of one channel");
        if (channels > static_cast<std::int64_t>(kMostLayers))
            fail(array.source, fmt::format("has {} channels a sample, more than {}", channels, kMostLayers));
        if (!options.layer)
            fail(array.source,
                 fmt::format("has {} channels a sample; choose one with --layer 0 to {}", channels, channels - 1));
        if (*options.layer >= channels)
            fail(array.source, fmt::format("has channels 0 to {}; there is no {}", channels - 1, *options.layer));
        array.components = static_cast<std::uint32_t>(channels);
        array.component = *options.layer;
        return;
    }
    choose_block(axes, options, array);
}

/// Rows of TransformMatrix are the directions of the axes.
void place_in_space(const HeaderFields& header, std::size_t dimension, Lattice& lattice) {
    Columns columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 origin{0, 0, 0};
    auto spacing = header.reals({"ElementSpacing"}, dimension);
    if (!spacing) spacing = header.reals({"ElementSize"}, dimension);
    const auto matrix = header.reals({"TransformMatrix", "Rotation", "Orientation"}, dimension * dimension);
    const auto offset = header.reals({"Offset", "Position", "Origin"}, dimension);
    for (std::size_t axis = 0; axis < std::min<std::size_t>(dimension, 3); ++axis) {
        const int column = static_cast<int>(axis);
        for (int row = 0; matrix && row < static_cast<int>(std::min<std::size_t>(dimension, 3)); ++row)
            columns[axis][row] = (*matrix)[axis * dimension + static_cast<std::size_t>(row)];
        if (spacing) columns[axis] = (*spacing)[axis] * columns[axis];
        if (offset) origin[column] = (*offset)[axis];
    }
    set_affine(header.path(), "map to space", "mend TransformMatrix, ElementSpacing or Offset", columns, origin,
               lattice);
}

void set_files(const MetaHeader& header, ArrayFile& array) {
    const HeaderFields& fields = header.fields;
    const std::string_view data = fields.text({kDataFile});
    std::error_code ignored;
    if (lower(data) == "local") {
        array.begin = header.end;
    } else if (data.starts_with("LIST")) {
        array.files = listed_files(array.source, header.behind);
    } else if (is_pattern(split_words(data)[0]) && !fs::exists(file_beside(array.source, data), ignored)) {
        array.files = numbered_files(array.source, data, array.lattice.size[2]);
    } else {
        array.files = {file_beside(array.source, data)};
    }
    const std::int64_t header_size = fields.integer("HeaderSize", 0);
    if (header_size < -1) fields.refuse("HeaderSize", "a count, or -1, is needed");
    if (header_size > 0) array.begin = static_cast<std::uint64_t>(header_size);  // from the start of the file
    if (header_size < 0) array.skipped_bytes = -1;
    array.encoding = !fields.flag({"BinaryData"}, true)       ? Encoding::kAscii
                     : fields.flag({"CompressedData"}, false) ? Encoding::kDeflated
                                                              : Encoding::kRaw;
}

}  // namespace

std::unique_ptr<SectionReader> open_meta_image(const fs::path& path, const ReadOptions& options) {
    const MetaHeader header = read_header(InputFile(path));
    const HeaderFields& fields = header.fields;
    ArrayFile array{.format = "metaimage", .source = path, .sample = sample_format(fields)};
    const std::int64_t channels = fields.integer("ElementNumberOfChannels", 1);
    if (channels < 1) fields.refuse("ElementNumberOfChannels", "one or more are needed");
    const std::int64_t dimension = fields.integer("NDims", 3);
    if (dimension < 2 || dimension > 10) fail(path, fmt::format("has {} axes (NDims); a volume has three", dimension));
    const auto sizes = axis_sizes(fields, static_cast<std::size_t>(dimension));
    array.lattice.size = checked_size(path, {sizes[0], sizes[1], sizes[2]});
    choose_volume(sizes, channels, options, array);
    place_in_space(fields, static_cast<std::size_t>(dimension), array.lattice);
    array.space = Space::kLps;  // as ITK, which made the format, reads and writes it
    set_files(header, array);
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
