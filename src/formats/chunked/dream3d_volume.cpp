#include "formats/chunked/dream3d_volume.h"

#include <algorithm>
#include <numeric>

#include "formats/array/volume_size.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

struct ImageGeometry {
    std::string path;  // of the group that contains the cell arrays
    std::vector<double> dimensions, spacing, origin;
};

std::vector<double> attribute(const Hdf5Entry& entry, const char* name) {
    const auto found = entry.numbers.find(name);
    return found == entry.numbers.end() ? std::vector<double>() : found->second;
}

/// Of both versions: the numbers are datasets of a group in version 7, attributes in version 8.
std::vector<ImageGeometry> image_geometries(const std::vector<Hdf5Entry>& entries) {
    constexpr std::string_view kGroup = "/_SIMPL_GEOMETRY";
    std::vector<ImageGeometry> geometries;
    const auto values = [&](const std::string& path) {
        const auto found = std::ranges::find(entries, path, &Hdf5Entry::path);
        return found == entries.end() ? std::vector<double>() : found->values;
    };
    for (const Hdf5Entry& entry : entries) {
        if (entry.path.starts_with("/DataContainers/") && entry.path.ends_with(kGroup)) {
            geometries.push_back({entry.path.substr(0, entry.path.size() - kGroup.size()),
                                  values(entry.path + "/DIMENSIONS"), values(entry.path + "/SPACING"),
                                  values(entry.path + "/ORIGIN")});
        } else if (entry.path.starts_with("/DataStructure/") && entry.numbers.contains("_DIMENSIONS")) {
            geometries.push_back({entry.path, attribute(entry, "_DIMENSIONS"), attribute(entry, "_SPACING"),
                                  attribute(entry, "_ORIGIN")});
        }
    }
    std::erase_if(geometries, [](const ImageGeometry& geometry) { return geometry.dimensions.size() != 3; });
    return geometries;
}

bool is_below(const std::string& path, const std::string& group) {
    return path.starts_with(group) &&
           (path.size() == group.size() || path[group.size()] == '/' || group.ends_with('/'));
}

const ImageGeometry* geometry_of(const std::vector<ImageGeometry>& geometries, const std::string& path) {
    const ImageGeometry* nearest = nullptr;
    for (const ImageGeometry& geometry : geometries) {
        if (is_below(path, geometry.path) && (!nearest || geometry.path.size() > nearest->path.size()))
            nearest = &geometry;
    }
    return nearest;
}

/// Along x, y, z.
std::optional<std::array<std::uint64_t, 3>> cell_counts(const ImageGeometry& geometry) {
    std::array<std::uint64_t, 3> counts{};
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = geometry.dimensions[axis];
        if (!(cells >= 1 && cells <= static_cast<double>(kMaxAxisSamples))) return std::nullopt;
        counts[axis] = static_cast<std::uint64_t>(cells);
    }
    return counts;
}

enum class Fit { kNone, kAxes, kFlat };

/// An array of cells has the axes z, y, x, or one for all cells, and may have one more for a single component.
Fit fit_of(const Hdf5Entry& array, const ImageGeometry& geometry) {
    const auto counts = cell_counts(geometry);
    std::vector<std::uint64_t> shape = array.shape;
    if ((shape.size() == 2 || shape.size() == 4) && shape.back() == 1) shape.pop_back();
    if (!counts) return Fit::kNone;
    const auto [x, y, z] = *counts;
    if (shape == std::vector{z, y, x}) return Fit::kAxes;
    return shape.size() == 1 && shape[0] / z == x * y && shape[0] % z == 0 ? Fit::kFlat : Fit::kNone;
}

/// The cell arrays of region numbers below `group`. Older files call a region a grain.
std::vector<Hdf5Entry> region_arrays(const std::vector<Hdf5Entry>& entries,
                                     const std::vector<ImageGeometry>& geometries, const std::string& group) {
    std::vector<Hdf5Entry> arrays;
    for (const char* name : {"/FeatureIds", "/GrainIds"}) {
        for (const Hdf5Entry& entry : entries) {
            if (!entry.is_dataset || !entry.path.ends_with(name) || !is_below(entry.path, group)) continue;
            const ImageGeometry* geometry = geometry_of(geometries, entry.path);
            if (geometry && fit_of(entry, *geometry) != Fit::kNone) arrays.push_back(entry);
        }
        if (!arrays.empty()) break;
    }
    return arrays;
}

Hdf5Entry choose_array(const std::filesystem::path& file, const std::vector<Hdf5Entry>& arrays) {
    if (arrays.size() == 1) return arrays.front();
    if (arrays.empty()) {
        fail(file, "no image geometry has a cell array FeatureIds; name another, as in " + file.string() +
                       ":/DataContainers/NAME/CellData/NAME");
    }
    fail(file, "holds several arrays FeatureIds; name one: " + list_datasets(file, arrays));
}

Hdf5Volume volume_of(const std::filesystem::path& file, const Hdf5Entry& array, const ImageGeometry& geometry) {
    const std::string source = file.string() + ":" + array.path;
    require_labels(source, array);
    const Fit fit = fit_of(array, geometry);
    if (fit == Fit::kNone) {
        fail(source, "the array does not fit the cells of its image geometry " + geometry.path +
                         "; name an array of cells, one component each");
    }
    Hdf5Volume volume{.format = "dream3d", .source = source, .dataset = array};
    if (fit == Fit::kFlat) volume.flat_size = cell_counts(geometry);
    volume.axis_names = array.shape.size() == 4 ? std::vector<std::string>{"z", "y", "x", "component"}
                                                : std::vector<std::string>{"z", "y", "x"};
    for (int axis = 0; axis < 3; ++axis) {
        if (geometry.spacing.size() == 3) volume.placement.spacing[axis] = geometry.spacing[axis];
        if (geometry.origin.size() == 3) volume.placement.origin[axis] = geometry.origin[axis];
        volume.placement.steps[axis] = 0.5;
    }
    return volume;
}

}  // namespace

std::optional<Hdf5Volume> find_dream3d_volume(Hdf5Reader& file, const std::string& inside) {
    if (!file.entry("/DataContainers") && !file.entry("/DataStructure")) return std::nullopt;
    const std::vector<Hdf5Entry> entries = file.entries();
    const std::vector<ImageGeometry> geometries = image_geometries(entries);
    const auto named = std::ranges::find(entries, inside, &Hdf5Entry::path);
    if (named != entries.end() && named->is_dataset) {
        const ImageGeometry* geometry = geometry_of(geometries, inside);
        return geometry ? std::optional(volume_of(file.path(), *named, *geometry)) : std::nullopt;
    }
    if (!inside.empty() && inside != "/" && named == entries.end()) return std::nullopt;
    const Hdf5Entry array =
        choose_array(file.path(), region_arrays(entries, geometries, inside.empty() ? "/" : inside));
    return volume_of(file.path(), array, *geometry_of(geometries, array.path));
}

}  // namespace regionmesh::formats
