// Several volumes as one: masks, a region a file.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Whether the extension is that of a file with a volume, which is neither an image nor bare samples.
bool is_volume_file(const std::filesystem::path& file);

/// The volumes in a folder, in natural order; none where it has images, which are its sections.
std::vector<std::filesystem::path> volumes_in(const std::filesystem::path& folder);

using OpenVolume = std::function<std::unique_ptr<SectionReader>(const std::filesystem::path&, const ReadOptions&)>;

/// A region a file, named by it, with labels from 1 in the order given. A sample belongs to the region where it is not
/// 0. `source` names the whole in messages. Throws Error(kInput) for files of several labels, and as join_layers()
/// does.
std::unique_ptr<SectionReader> open_masks(const std::vector<std::filesystem::path>& files,
                                          const std::filesystem::path& source, const ReadOptions& options,
                                          const OpenVolume& open);

/// The label of the volume with the largest sample. Several files: numbered from 1 and named as masks, and 0 where none
/// reaches options.threshold, or 0.5. The volumes of one file: numbered from 0. `open` makes reals of samples.
std::unique_ptr<SectionReader> open_argmax(const std::vector<std::filesystem::path>& files,
                                           const std::filesystem::path& source, const ReadOptions& options,
                                           const OpenVolume& open);

}  // namespace regionmesh::formats
