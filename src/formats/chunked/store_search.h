// Looks through the folders of a store for the one volume that may be meant.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace regionmesh::formats {

enum class StoreEntry {
    kVolume,
    kOther,  // not to be looked into
    kGroup,
};

/// Of two axes or three with more than one sample, so that it may be a volume.
bool may_be_volume(const std::vector<std::uint64_t>& shape);

/// The only volume below `folder`. `describe` says what a folder is; where it throws, as for floats, that is no volume.
/// Throws where there are none or several, naming some. Looks at 100,000 folders at most, 8 levels deep.
std::filesystem::path only_volume(const std::filesystem::path& folder,
                                  const std::function<StoreEntry(const std::filesystem::path&)>& describe);

}  // namespace regionmesh::formats
