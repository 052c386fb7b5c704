// The metadata of Zarr arrays and groups, version 2 and 3.
#pragma once

#include <optional>

#include "formats/chunked/store_array.h"

namespace regionmesh::formats {

/// What the files `.zarray` and `.zattrs` (version 2) or `zarr.json` (version 3) of a folder say. Nothing where it is
/// no array. Throws for what is not read: filters, codecs beside the known ones, floats.
std::optional<StoreArray> read_zarr_array(const std::filesystem::path& folder);

/// The attributes of an array or group; null where the folder is neither.
nlohmann::json read_zarr_attributes(const std::filesystem::path& folder);

/// Whether a folder is an array or group of Zarr, as far as its own files say.
bool is_zarr(const std::filesystem::path& folder);

}  // namespace regionmesh::formats
