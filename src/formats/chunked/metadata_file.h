// JSON beside the samples: small files that say what the large ones mean.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/input_file.h"

namespace regionmesh::formats {

/// Nothing where there is no such file. Throws where it is no JSON, larger than 64 MiB or nested deeper than 100.
std::optional<nlohmann::json> read_json(const std::filesystem::path& path);

/// Calls `read`, which looks into JSON from `path`; a key that is not there or of another type is an Error naming the
/// file.
template <class Read>
auto reading(const std::filesystem::path& path, Read&& read) {
    try {
        return read();
    } catch (const nlohmann::json::exception& problem) {
        fail(path,
             std::string("the metadata are not as they should be (") + problem.what() + "); write the file again");
    }
}

}  // namespace regionmesh::formats
