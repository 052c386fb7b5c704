// The metadata of Zarr arrays and groups, version 2 and 3.
#pragma once

#include <optional>

#include "formats/chunked/store_array.h"

namespace regionmesh::formats {

/// Reads `.zarray` and `.zattrs` (version 2) or `zarr.json` (version 3) of a folder. Nothing if the folder is no array.
/// Throws for filters, unknown codecs and samples that are no integers.
std::optional<StoreArray> read_zarr_array(const std::filesystem::path& folder);

/// The attributes of an array or group; null if the folder is neither.
nlohmann::json read_zarr_attributes(const std::filesystem::path& folder);

}  // namespace regionmesh::formats
