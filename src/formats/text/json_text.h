// JSON from files, which may be damaged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/input_file.h"

namespace regionmesh::formats {

/// Throws nlohmann::json::exception where `text` is no JSON, and Error(kInput) that names `path` where it is nested
/// deeper than 100: copies of JSON recurse into it.
nlohmann::json parse_json(const std::filesystem::path& path, const std::string& text);

/// Nothing where there is no such file. Throws Error(kInput) where it is no JSON, larger than 64 MiB or nested deeper
/// than 100.
std::optional<nlohmann::json> read_json(const std::filesystem::path& path);

/// A whole number from 0 to `most`; 3.0 is one, too. Throws Error(kInput) that names the file.
std::uint64_t whole_number(const std::filesystem::path& path, const nlohmann::json& json,
                           std::uint64_t most = UINT64_MAX);
/// A list of them. Throws nlohmann::json::exception where it is no list.
std::vector<std::uint64_t> whole_numbers(const std::filesystem::path& path, const nlohmann::json& list);

/// What is wrong, without the number that the library puts in front.
std::string problem_text(const nlohmann::json::exception& problem);

/// Calls `read`, which looks into JSON from `path`; a key that is missing or of another type is an Error that names the
/// file.
template <class Read>
auto reading(const std::filesystem::path& path, Read&& read) {
    try {
        return read();
    } catch (const nlohmann::json::exception& problem) {
        fail(path, "the metadata are not as they should be (" + problem_text(problem) + "); write the file again");
    }
}

}  // namespace regionmesh::formats
