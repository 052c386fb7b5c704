// The keys of a JSON object in the order in which they are written.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace regionmesh::test {

using Json = nlohmann::ordered_json;

inline std::vector<std::string> keys_of(const Json& json) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    return keys;
}

}  // namespace regionmesh::test
