// OME-Zarr (NGFF) 0.1 to 0.5: what its metadata say of the arrays of an image.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "regionmesh/label_names.h"

namespace regionmesh::formats {

/// One resolution of an image. Lists have one entry for each axis, the slowest first.
struct OmeLevel {
    std::filesystem::path folder;
    std::vector<std::string> axes;
    std::vector<double> scale, translation;
};

/// The resolutions of the first image of a group, the finest first; none where the attributes are not of OME-Zarr.
/// Throws for transformations that are none of identity, scale and translation, and for paths that leave the group.
std::vector<OmeLevel> ome_levels(const std::filesystem::path& group, const nlohmann::json& attributes);

/// Names that `image-label` gives to labels, in a property `name`, `label` or `class`.
LabelNames ome_label_names(const nlohmann::json& attributes);

}  // namespace regionmesh::formats
