// The start of a run over a folder of pieces.
#pragma once

#include <functional>
#include <memory>

#include "blocks/folder_lock.h"
#include "blocks/labels_in_place.h"
#include "blocks/manifest.h"
#include "regionmesh/blocks.h"

namespace regionmesh {

using OnBlocks = std::function<void(const BlockProgress&)>;

/// The labels of a volume that cannot be read in place, while blocks are reconstructed: a file of the folder.
inline constexpr const char* kStagedLabels = "volume.labels";

/// A file of the folder that says that such a copy is complete.
inline constexpr const char* kCopied = "copied";

/// A file of the folder: how far the run was when it was last started, while blocks are reconstructed.
inline constexpr const char* kLastStart = "last-start";

/// Names of files of the folder that are not needed once the manifest has labels and faces begin so.
inline constexpr const char* kSurveyPart = "survey-";

/// Makes the folder, reads the input once and writes the manifest: labels, faces, size of the blocks. Where the folder
/// has these already, it only looks whether they belong to the same run. All processes call it; they share the reading
/// where any box of the input can be read. Returns the lock of the folder, which the first process has. Throws like
/// reconstruct_blocks().
[[nodiscard]] std::unique_ptr<FolderLock> begin_run(const OpenSections& open, const ReconstructOptions& options,
                                                    const BlockOptions& blocks, BlockTasks& tasks,
                                                    const OnBlocks& on_progress);

/// Throws Error(kInput) where the input is no longer as it was when the run began.
void require_unchanged(const BlockOptions& blocks);

/// The manifest of the folder. No process goes on, to write it anew, before all have read it. All of them call it.
Manifest read_manifest_together(const std::filesystem::path& folder, BlockTasks& tasks);

}  // namespace regionmesh
