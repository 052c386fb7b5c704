// https://ngff.openmicroscopy.org
#include "formats/chunked/ome_zarr.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "formats/text/json_text.h"
#include "formats/text/length_unit.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Version 0.5 puts the metadata under "ome".
const Json& ome_part(const Json& attributes) {
    return attributes.is_object() && attributes.contains("ome") ? attributes.at("ome") : attributes;
}

/// A system of coordinates is named by a word, or by an object with a name.
std::string system_name(const Json& reference) {
    if (reference.is_object()) return reference.value("name", "");
    return reference.is_string() ? reference.get<std::string>() : "";
}

/// Since version 0.6 axes belong to systems of coordinates: those of the system into which the samples of the finest
/// resolution are placed; the first where none is named so.
Json axes_of(const Json& image) {
    if (image.contains("axes")) return image.at("axes");
    const Json systems = image.value("coordinateSystems", Json::array());
    if (systems.empty()) return {};
    std::string wanted;
    const Json& datasets = image.at("datasets");
    if (!datasets.empty()) {
        const Json steps = datasets.at(0).value("coordinateTransformations", Json::array());
        if (!steps.empty()) wanted = system_name(steps.back().value("output", Json()));
    }
    for (const Json& system : systems)
        if (system.at("name") == wanted) return system.at("axes");
    return systems.at(0).at("axes");
}

/// Axes are objects since version 0.4 and words in 0.3; older versions have a fixed order without names.
std::vector<std::string> axis_names(const Json& image) {
    const Json axes = axes_of(image);
    if (axes.is_null()) return {"t", "c", "z", "y", "x"};
    std::vector<std::string> names;
    for (const Json& axis : axes) {
        const std::string name = axis.is_string() ? axis : axis.at("name");
        names.push_back(lower(name));
    }
    return names;
}

/// Applies the transformations one after another.
void transform(const fs::path& group, const Json& transformations, OmeLevel& level, int depth = 0) {
    constexpr int kMostDepth = 4;
    if (depth > kMostDepth) fail(group, "sequences of transformations lie in one another; write them as one");
    for (const Json& step : transformations) {
        const std::string type = step.at("type");
        if (type == "identity") continue;
        if (type == "sequence") {
            transform(group, step.at("transformations"), level, depth + 1);
            continue;
        }
        if ((type != "scale" && type != "translation") || !step.contains(type))
            fail(group, "positions in space are given by '" + type + "', which is not read; scale and translation are");
        const auto numbers = step.at(type).get<std::vector<double>>();
        level.scale.resize(numbers.size(), 1);
        level.translation.resize(numbers.size(), 0);
        for (std::size_t axis = 0; axis < numbers.size(); ++axis) {
            if (type == "translation") level.translation[axis] += numbers[axis];
            if (type == "scale") level.scale[axis] *= numbers[axis];
            if (type == "scale") level.translation[axis] *= numbers[axis];
        }
    }
}

/// Turns axes that have another unit than x into that of x, which becomes that of the level. An axis without a unit
/// stays as it is.
void use_one_unit(const fs::path& group, const Json& image, OmeLevel& level) {
    std::vector<std::string> units(level.axes.size());
    std::string wanted;
    const Json axes = axes_of(image);
    for (std::size_t axis = 0; axis < std::min(axes.size(), units.size()); ++axis) {
        if (axes[axis].is_object() && axes[axis].value("unit", Json()).is_string())
            axes[axis].at("unit").get_to(units[axis]);
        if (level.axes[axis] == "x") wanted = units[axis];
    }
    for (std::size_t axis = 0; axis < std::min(units.size(), level.scale.size()); ++axis) {
        const bool is_of_space = level.axes[axis] == "y" || level.axes[axis] == "z";
        if (!is_of_space || wanted.empty() || units[axis].empty() || units[axis] == wanted) continue;
        const auto own = femtometres_in(units[axis]), in_wanted = femtometres_in(wanted);
        if (!own || !in_wanted)
            fail(group, "axis " + level.axes[axis] + " is in " + shown(units[axis]) + " and axis x in " +
                            shown(wanted) + "; write both in one unit of length");
        level.scale[axis] *= *own / *in_wanted;
        level.translation[axis] *= *own / *in_wanted;
    }
    level.metres = metres_in(wanted);
}

bool leaves_its_folder(const fs::path& path) {
    return path.is_absolute() || std::ranges::find(path, "..") != path.end();
}

}  // namespace

std::vector<OmeLevel> ome_levels(const fs::path& group, const Json& attributes) {
    const Json& ome = ome_part(attributes);
    if (!ome.is_object() || !ome.contains("multiscales")) return {};
    return reading(group, [&] {
        std::vector<OmeLevel> levels;
        const Json& image = ome.at("multiscales").at(0);
        for (const Json& dataset : image.at("datasets")) {
            const fs::path path = dataset.at("path").get<std::string>();
            if (leaves_its_folder(path)) fail(group, "an image has its samples at " + path.string() + ", outside");
            OmeLevel level{.folder = group / path, .axes = axis_names(image), .scale = {}, .translation = {}};
            const Json none = Json::array();
            transform(group, dataset.value("coordinateTransformations", none), level);
            // Since 0.6 those of the image lead into other systems than its own.
            if (!image.contains("coordinateSystems"))
                transform(group, image.value("coordinateTransformations", none), level);
            use_one_unit(group, image, level);
            levels.push_back(std::move(level));
        }
        if (levels.empty()) fail(group, "the image has no resolution; write the file again");
        return levels;
    });
}

LabelNames ome_label_names(const Json& attributes) {
    const Json& ome = ome_part(attributes);
    LabelNames names;
    if (!ome.is_object() || !ome.contains("image-label")) return names;
    const Json& properties = ome.at("image-label").value("properties", Json::array());
    for (const Json& property : properties) {
        if (!property.is_object() || !property.value("label-value", Json()).is_number_integer()) continue;
        for (const char* key : {"name", "label", "class"}) {
            const Json word = property.value(key, Json());
            if (!word.is_string() || word.get<std::string>().empty()) continue;
            std::string text = word;
            std::ranges::replace_if(
                text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
            names[property.at("label-value").get<InputLabel>()] = text;
            break;
        }
    }
    return names;
}

LabelColours ome_label_colours(const Json& attributes) {
    const Json& ome = ome_part(attributes);
    LabelColours colours;
    if (!ome.is_object() || !ome.contains("image-label")) return colours;
    const Json& all = ome.at("image-label").value("colors", Json::array());
    for (const Json& entry : all) {
        if (!entry.is_object() || !entry.value("label-value", Json()).is_number_integer()) continue;
        const Json rgba = entry.value("rgba", Json());
        if (!rgba.is_array() || rgba.size() < 3) continue;
        std::uint32_t colour = 0;
        const bool is_whole = std::all_of(rgba.begin(), rgba.begin() + 3, [&](const Json& part) {
            if (!part.is_number_unsigned() || part.get<std::uint64_t>() > 255) return false;
            colour = colour << 8 | part.get<std::uint32_t>();
            return true;
        });
        if (is_whole) colours[entry.at("label-value").get<InputLabel>()] = colour;
    }
    return colours;
}

}  // namespace regionmesh::formats
