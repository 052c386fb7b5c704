// MetaImage, ITK's own format: https://itk.org/Wiki/ITK/MetaIO/Documentation
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "formats/array/affine.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/chunked/stored_samples.h"
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

class MetaHeader {
public:
    explicit MetaHeader(const InputFile& file);

    const fs::path& path() const { return path_; }
    std::uint64_t end() const { return end_; }           // of the header
    const std::string& behind() const { return rest_; }  // lines behind the last key

    /// Of the first of several names that a key has had.
    std::string_view text(std::initializer_list<std::string_view> keys) const {
        for (const std::string_view key : keys)
            if (const auto found = fields_.find(key); found != fields_.end()) return found->second;
        return {};
    }
    bool flag(std::initializer_list<std::string_view> keys, bool otherwise) const {
        const std::string_view word = text(keys);
        return word.empty() ? otherwise : word[0] == 'T' || word[0] == 't' || word[0] == '1';
    }
    std::optional<std::vector<double>> reals(std::initializer_list<std::string_view> keys, std::size_t count) const {
        const std::string_view words = text(keys);
        if (words.empty()) return std::nullopt;
        auto numbers = parse_reals(words);
        if (!numbers || numbers->size() != count)
            refuse(*keys.begin(), words, fmt::format("{} numbers are needed", count));
        return numbers;
    }
    std::int64_t integer(std::string_view key, std::int64_t otherwise) const {
        const std::string_view word = text({key});
        if (word.empty()) return otherwise;
        const auto number = parse_integer(word);
        if (!number) refuse(key, word, "a whole number is needed");
        return *number;
    }
    [[noreturn]] void refuse(std::string_view key, std::string_view value, const std::string& wanted) const {
        fail(path_, fmt::format("{} is '{}': {}", key, shown(value), wanted));
    }

private:
    fs::path path_;
    std::map<std::string, std::string, std::less<>> fields_;
    std::string rest_;
    std::uint64_t end_ = 0;
};

MetaHeader::MetaHeader(const InputFile& file) : path_(file.path()) {
    std::string bytes(std::min<std::uint64_t>(file.size(), kMostHeaderBytes), '\0');
    bytes.resize(file.read(0, std::as_writable_bytes(std::span(bytes))));
    std::string_view rest = bytes;
    while (!rest.empty()) {
        const std::string_view line = take_line(rest);
        const std::size_t equals = std::min(line.find_first_of("=:"), line.size());
        const std::string key(trim(line.substr(0, equals)));
        if (equals == line.size() && !key.empty())
            fail(path_, fmt::format("line '{}' is no MetaImage header ('key = value'); check the file", shown(line)));
        if (key.empty()) continue;
        fields_.emplace(key, trim(line.substr(equals + 1)));
        if (key == kDataFile) {
            end_ = bytes.size() - rest.size();
            if (text({kDataFile}).starts_with("LIST")) rest_ = rest;
            return;
        }
    }
    fail(path_, "has no ElementDataFile at the end of its header; it is truncated or no MetaImage");
}

SampleFormat sample_format(const MetaHeader& header) {
    const std::string_view word = header.text({"ElementType"});
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& entry) { return entry.first == word; });
    if (found == kTypes.end())
        header.refuse("ElementType", word, "labels must be integers: convert them, to MET_INT say");
    return {found->second, header.flag({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false)};
}

/// Axes beyond the third may have one sample.
std::array<std::uint64_t, 3> volume_size(const MetaHeader& header, std::size_t dimension) {
    const std::string_view words = header.text({"DimSize"});
    const auto sizes = parse_sizes(words);
    if (!sizes || sizes->size() != dimension) header.refuse("DimSize", words, "a count for each axis is needed");
    std::array<std::uint64_t, 3> size{1, 1, 1};
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        if (axis < 3)
            size[axis] = (*sizes)[axis];
        else if ((*sizes)[axis] != 1)
            header.refuse("DimSize", words, "holds several volumes; save one of them alone");
    }
    return size;
}

/// Rows of TransformMatrix are the directions of the axes.
void place_in_space(const MetaHeader& header, std::size_t dimension, Lattice& lattice) {
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

void set_files(const MetaHeader& header, StoredSamples& samples) {
    const std::string_view data = header.text({kDataFile});
    if (lower(data) == "local") {
        samples.files = {header.path()};
        samples.begin = header.end();
    } else if (data.starts_with("LIST")) {
        samples.files = listed_files(header.path(), header.behind());
    } else if (const auto words = split_words(data); words.size() >= 3 && is_pattern(words[0])) {
        samples.files = numbered_files(header.path(), data);
    } else {
        samples.files = {file_beside(header.path(), data)};
    }
    const std::int64_t header_size = header.integer("HeaderSize", 0);
    if (header_size < -1) header.refuse("HeaderSize", header.text({"HeaderSize"}), "a count, or -1, is needed");
    if (header_size > 0) samples.begin = static_cast<std::uint64_t>(header_size);  // from the front of the file
    if (header_size < 0) samples.skipped_bytes = -1;
    samples.encoding = !header.flag({"BinaryData"}, true)       ? Encoding::kAscii
                       : header.flag({"CompressedData"}, false) ? Encoding::kDeflated
                                                                : Encoding::kRaw;
}

}  // namespace

std::unique_ptr<SectionReader> open_meta_image(const fs::path& path, const ReadOptions& options) {
    const MetaHeader header{InputFile(path)};
    StoredSamples samples;
    samples.format = sample_format(header);
    if (const std::int64_t channels = header.integer("ElementNumberOfChannels", 1); channels != 1)
        fail(path, fmt::format("has {} channels a sample; labels have one: save one channel alone", channels));
    const std::int64_t dimension = header.integer("NDims", 3);
    if (dimension < 2 || dimension > 10) fail(path, fmt::format("has {} axes (NDims); a volume has three", dimension));
    VolumeInfo info = volume_info(path, "metaimage", samples.format.type,
                                  checked_size(path, volume_size(header, static_cast<std::size_t>(dimension))));
    place_in_space(header, static_cast<std::size_t>(dimension), info.lattice);
    set_files(header, samples);
    info.names = names_beside(path);
    return open_samples(samples, std::move(info), options);
}

}  // namespace regionmesh::formats
