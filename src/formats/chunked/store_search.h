// Searches the folders of a store for its only volume.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace regionmesh::formats {

enum class StoreEntry {
    kVolume,
    kOther,  // not searched
    kGroup,
};

/// The only volume below `folder`. `describe` classifies a folder; if it throws, as for floats, the folder is no
/// volume. Throws if there is none, or several, of which some are named. Searches at most 100,000 folders, 8 levels
/// deep.
std::filesystem::path only_volume(const std::filesystem::path& folder,
                                  const std::function<StoreEntry(const std::filesystem::path&)>& describe);

/// The path of a folder from the root, without "." and "..": as it is written, and where its links lead if that is
/// elsewhere. The folders above either may describe it.
std::vector<std::filesystem::path> whole_paths(const std::filesystem::path& folder);

}  // namespace regionmesh::formats
