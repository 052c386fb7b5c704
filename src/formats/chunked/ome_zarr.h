// Reads the metadata of OME-Zarr images (NGFF 0.1 to 0.5).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/label_names.h"

namespace regionmesh::formats {

/// One resolution of an image. Lists have one entry for each axis, the slowest first.
struct OmeLevel {
    std::filesystem::path folder;
    std::vector<std::string> axes;
    std::vector<double> scale, translation;
    std::optional<double> metres = {};  // in their unit
};

/// The resolutions of the first image of a group, the finest first; empty if the attributes are not those of OME-Zarr.
/// Throws for transformations other than identity, scale and translation, and for paths outside the group.
std::vector<OmeLevel> ome_levels(const std::filesystem::path& group, const nlohmann::json& attributes);

/// The names of labels in `image-label`: the properties `name`, `label` or `class`.
LabelNames ome_label_names(const nlohmann::json& attributes);

/// The colours of labels in `image-label`: `rgba`, 0 to 255. Ignores entries of another form.
LabelColours ome_label_colours(const nlohmann::json& attributes);

}  // namespace regionmesh::formats
