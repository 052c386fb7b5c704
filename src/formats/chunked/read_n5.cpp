// https://github.com/saalfeldlab/n5: the file system specification.
#include <algorithm>
#include <charconv>
#include <numeric>

#include "formats/array/volume_formats.h"
#include "formats/chunked/store_array.h"
#include "formats/chunked/store_search.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "formats/text/json_text.h"
#include "formats/text/length_unit.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kFile = "attributes.json";
constexpr int kMaxLevelDepth = 4;  // folders above an array whose attributes are read

Json attributes_of(const fs::path& folder) { return read_json(folder / kFile).value_or(Json::object()); }

bool is_array(const Json& attributes) {
    return attributes.is_object() && attributes.contains("dimensions") && attributes.contains("dataType");
}

std::vector<Codec> parse_compression(const fs::path& metadata, const Json& attributes) {
    const Json compression = attributes.value("compression", attributes.value("compressionType", Json("raw")));
    const std::string name = compression.is_string() ? compression : compression.at("type");
    if (name == "raw") return {};
    const auto codec = parse_codec(name);
    if (!codec || *codec == Codec::kCrc32c) refuse_codec(metadata, name);
    return {*codec};
}

/// Lists of N5 have the fastest axis first.
std::vector<std::uint64_t> slowest_first(std::vector<std::uint64_t> numbers) {
    std::ranges::reverse(numbers);
    return numbers;
}

StoreArray parse_array(const fs::path& folder, const Json& attributes) {
    const fs::path metadata = folder / kFile;
    StoreArray array{.folder = folder, .attributes = attributes};
    reading(metadata, [&] {
        array.shape = slowest_first(whole_numbers(metadata, attributes.at("dimensions")));
        array.chunk = slowest_first(whole_numbers(metadata, attributes.at("blockSize")));
        array.format = format_of(metadata, attributes.at("dataType"), /*is_big_endian=*/true);
        array.codecs = parse_compression(metadata, attributes);
    });
    array.file = array.chunk;
    array.stored.resize(array.chunk.size());
    std::iota(array.stored.begin(), array.stored.end(), 0);
    array.fill.resize(sample_bytes(array.format));
    array.has_head = true;
    array.names = {.separator = '/', .is_reversed = true};
    check_array(array, metadata);
    return array;
}

/// `s0` of a group is its finest resolution.
fs::path find(const fs::path& folder) {
    if (is_array(attributes_of(folder))) return folder;
    if (is_array(attributes_of(folder / "s0"))) return folder / "s0";
    const fs::path only = only_volume(folder, [](const fs::path& below) {
        if (is_array(attributes_of(below / "s0"))) return StoreEntry::kVolume;
        const Json attributes = attributes_of(below);
        if (!is_array(attributes)) return StoreEntry::kGroup;
        return may_be_volume(parse_array(below, attributes).shape) ? StoreEntry::kVolume : StoreEntry::kOther;
    });
    return is_array(attributes_of(only)) ? only : only / "s0";
}

/// Three numbers or more, alone or under `dimensions`.
std::vector<double> numbers_of(const Json& attributes, const char* key) {
    std::vector<double> numbers;
    const Json value = attributes.is_object() ? attributes.value(key, Json()) : Json();
    const Json list = value.is_object() ? value.value("dimensions", Json()) : value;
    for (const Json& number : list.is_array() ? list : Json::array()) {
        if (number.is_number()) numbers.push_back(number);
    }
    return numbers;
}

/// For an array called `s3`, entry 3 of the list of all levels in a group above it.
std::vector<double> factors_of_level(const fs::path& array, const Json& attributes) {
    const std::string name = array.filename().string();
    std::size_t level = 0;
    if (name.size() < 2 || name[0] != 's' ||
        std::from_chars(&name[1], name.data() + name.size(), level).ptr != name.data() + name.size()) {
        return {};
    }
    for (const char* key : {"downsamplingFactors", "scales"}) {
        const Json list = attributes.is_object() ? attributes.value(key, Json()) : Json();
        if (list.is_array() && level < list.size() && list.at(level).is_array())
            return numbers_of({{"factors", list.at(level)}}, "factors");
    }
    return {};
}

/// The numbers of the array come before those of the groups around it, and nearer groups before farther ones.
struct Found {
    std::vector<double> resolution, factors, offset;
    std::optional<double> metres = {};  // in the unit of the resolution
};

/// The metres of the unit that a list names for each axis. None for several, and for unknown ones.
std::optional<double> common_unit(const Json& units) {
    if (!units.is_array() || units.empty() || !units.front().is_string()) return {};
    const bool is_one = std::ranges::all_of(units, [&](const Json& unit) { return unit == units.front(); });
    return is_one ? metres_in(units.front().get<std::string>()) : std::nullopt;
}

/// {"pixelResolution": {"dimensions": [4, 4, 40], "unit": "nm"}}, or {"resolution": [4, 4, 40], "units": ["nm", ...]}.
std::optional<double> unit_of(const Json& attributes, const char* key) {
    const Json& resolution = attributes.at(key);
    if (!resolution.is_object()) return common_unit(attributes.value("units", Json()));
    const Json unit = resolution.value("unit", Json());
    return unit.is_string() ? metres_in(unit.get<std::string>()) : std::nullopt;
}

Found find_numbers(const fs::path& array) {
    Found found;
    for (const fs::path& whole : whole_paths(array)) {
        fs::path folder = whole;
        for (int depth = 0; depth <= kMaxLevelDepth; ++depth, folder = folder.parent_path()) {
            const Json attributes = attributes_of(folder);
            for (const char* key : {"pixelResolution", "resolution"}) {
                if (!found.resolution.empty()) break;
                found.resolution = numbers_of(attributes, key);
                if (!found.resolution.empty()) found.metres = unit_of(attributes, key);
            }
            if (found.offset.empty()) found.offset = numbers_of(attributes, "offset");
            if (found.factors.empty() && depth == 0) found.factors = numbers_of(attributes, "downsamplingFactors");
            if (found.factors.empty() && depth > 0) found.factors = factors_of_level(whole, attributes);
            if (attributes.is_object() && attributes.contains("n5")) break;  // the root
        }
    }
    return found;
}

/// With named axes: {"axes": ["z", "y", "x"], "scale": [...], "translate": [...], "units": ["nm", "nm", "nm"]}.
bool take_transform(const Json& attributes, Placement& placement) {
    const Json transform = attributes.value("transform", Json());
    if (!transform.is_object() || !transform.value("axes", Json()).is_array()) return false;
    const std::vector<double> scale = numbers_of(transform, "scale"), translate = numbers_of(transform, "translate");
    const Json& axes = transform.at("axes");
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::string name = axes[i].is_string() ? lower(axes[i].get<std::string>()) : "";
        const std::size_t axis = name.size() == 1 ? std::string_view("xyz").find(name) : 3;
        if (axis > 2) continue;
        if (i < scale.size()) placement.spacing[axis] = scale[i];
        if (i < translate.size()) placement.origin[axis] = translate[i];
    }
    placement.metres = common_unit(transform.value("units", Json()));
    return true;
}

/// A sample of a coarser level lies in the middle of the samples it was made from. Lists have a number for each axis of
/// the array, the first axis of the file first, or else for x, y, z.
Placement placement_of(const StoreArray& array, const ArrayAxes& axes) {
    Placement placement;
    if (take_transform(array.attributes, placement)) return placement;
    const Found found = find_numbers(array.folder);
    placement.metres = found.metres;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto number = [&](const std::vector<double>& numbers, double otherwise) {
            std::size_t at = axis;
            if (numbers.size() == array.shape.size() && axes.axis[axis] >= 0)
                at = numbers.size() - 1 - static_cast<std::size_t>(axes.axis[axis]);
            return at < numbers.size() ? numbers[at] : otherwise;
        };
        const double resolution = number(found.resolution, 1), factor = number(found.factors, 1);
        placement.spacing[axis] = resolution * factor;
        placement.origin[axis] = number(found.offset, 0);
        placement.steps[axis] = factor != 0 ? (factor - 1) / factor / 2 : 0;
    }
    return placement;
}

}  // namespace

bool is_n5(const fs::path& folder) {
    const Json attributes = attributes_of(folder);
    if (is_array(attributes) || (attributes.is_object() && attributes.contains("n5"))) return true;
    return is_array(attributes_of(folder / "s0"));
}

std::unique_ptr<SectionReader> open_n5(const fs::path& path, const ReadOptions& options) {
    fs::path folder = path.lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    const fs::path found = find(folder);
    StoreArray array = parse_array(found, attributes_of(found));
    StoreVolume volume{.format = "n5", .source = path.string()};
    volume.axes = choose_axes(found, array.shape, {}, options);
    volume.placement = placement_of(array, volume.axes);
    return open_store_array(std::move(array), std::move(volume), options);
}

}  // namespace regionmesh::formats
