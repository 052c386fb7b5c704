#include <algorithm>

#include "formats/array/volume_formats.h"
#include "formats/chunked/ome_zarr.h"
#include "formats/chunked/store_search.h"
#include "formats/chunked/zarr_array.h"
#include "formats/input_file.h"
#include "formats/text/json_text.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kMaxLevelDepth = 4;  // folders between an image and its arrays

/// An array, and the metadata of the image to which it belongs.
struct Found {
    fs::path folder;
    std::optional<OmeLevel> level = {};
    LabelNames names = {};
    LabelColours colours = {};
    std::vector<fs::path> files = {};  // the metadata of the image
};

std::vector<fs::path> metadata_of(const fs::path& group) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const char* name : {"zarr.json", ".zattrs"})
        if (fs::exists(group / name, ignored)) files.push_back(group / name);
    return files;
}

Found from_image(const fs::path& group, const OmeLevel& level, const Json& attributes) {
    return {level.folder, level, reading(group, [&] { return ome_label_names(attributes); }),
            reading(group, [&] { return ome_label_colours(attributes); }), metadata_of(group)};
}

/// Searches the folders above for the image that has the array as one of its resolutions.
Found with_image(const fs::path& array) {
    for (const fs::path& whole : whole_paths(array)) {
        fs::path group = whole.parent_path();
        for (int depth = 0; depth < kMaxLevelDepth; ++depth, group = group.parent_path()) {
            const Json attributes = read_zarr_attributes(group);
            for (const OmeLevel& level : ome_levels(group, attributes))
                if (level.folder.lexically_normal() == whole) return from_image(group, level, attributes);
        }
    }
    return {array};
}

bool is_array(const fs::path& folder) {
    const auto array = read_zarr_array(folder);
    return array.has_value();
}

Found find(const fs::path& folder) {
    if (is_array(folder)) return with_image(folder);
    const Json attributes = read_zarr_attributes(folder);
    const auto levels = ome_levels(folder, attributes);
    if (!levels.empty()) return from_image(folder, levels.front(), attributes);
    const fs::path only = only_volume(folder, [](const fs::path& below) {
        if (!ome_levels(below, read_zarr_attributes(below)).empty()) return StoreEntry::kVolume;
        const auto array = read_zarr_array(below);
        if (!array) return StoreEntry::kGroup;
        return may_be_volume(array->shape) ? StoreEntry::kVolume : StoreEntry::kOther;
    });
    return find(only);
}

/// The numbers under a name in the attributes.
FindNumbers numbers_in(const Json& attributes) {
    return [&attributes](const std::string& name) -> std::optional<std::vector<double>> {
        if (!attributes.is_object() || !attributes.contains(name)) return {};
        const Json& value = attributes.at(name);
        const Json list = value.is_array() ? value : Json::array({value});
        const bool has_numbers = std::ranges::all_of(list, [](const Json& entry) { return entry.is_number(); });
        return has_numbers ? list.get<std::vector<double>>() : std::vector<double>();
    };
}

Placement level_placement(const fs::path& folder, const OmeLevel& level, const ArrayAxes& axes,
                          std::size_t axis_count) {
    Placement placement;
    if (level.scale.empty()) return placement;
    placement.metres = level.metres;
    if (level.scale.size() != axis_count) fail(folder, "the image's scale has another number of axes than the array");
    for (int axis = 0; axis < 3; ++axis) {
        if (axes.axis[axis] < 0) continue;
        placement.spacing[axis] = level.scale[axes.axis[axis]];
        placement.origin[axis] = level.translation[axes.axis[axis]];
    }
    return placement;
}

/// xarray names axes so in version 2.
void add_axis_names(StoreArray& array) {
    if (!array.axis_names.empty() || !array.attributes.is_object()) return;
    const Json names = array.attributes.value("_ARRAY_DIMENSIONS", Json::array());
    if (names.is_array() && std::ranges::all_of(names, [](const Json& name) { return name.is_string(); }))
        names.get_to(array.axis_names);
}

}  // namespace

std::unique_ptr<SectionReader> open_zarr(const fs::path& path, const ReadOptions& options) {
    fs::path folder = path.lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    Found found = find(folder);
    auto array = read_zarr_array(found.folder);
    if (!array) fail(found.folder, "the image names this array, which is not there; fetch the store again");
    add_axis_names(*array);
    StoreVolume volume{.format = "zarr",
                       .source = path.string(),
                       .names = std::move(found.names),
                       .colours = std::move(found.colours),
                       .files = std::move(found.files)};
    const std::size_t axis_count = array->shape.size();
    if (found.level) {
        if (found.level->axes.size() != axis_count)
            fail(found.folder, "the image names another number of axes than the array has; write it again");
        volume.axes = choose_axes(found.folder, array->shape, found.level->axes, options);
        volume.placement = level_placement(found.folder, *found.level, volume.axes, axis_count);
    } else {
        volume.axes = choose_axes(found.folder, array->shape, array->axis_names, options);
        volume.placement = common_placement(volume.axes, axis_count, options, numbers_in(array->attributes));
    }
    return open_store_array(std::move(*array), std::move(volume), options);
}

}  // namespace regionmesh::formats
