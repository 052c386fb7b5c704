// Models in pieces.
#pragma once

#include <filesystem>
#include <vector>

#include "regionmesh/blocks.h"
#include "regionmesh/options.h"

namespace regionmesh::cli {

/// Whether the output of reconstruct is a folder of pieces: --block-size is given, or --output names a folder.
bool writes_blocks(const Settings& settings);

/// Whether convert writes the output piece by piece: .pvtp, and folders .precomputed of a folder of pieces.
bool is_written_in_pieces(const Settings& settings);

/// A folder for Neuroglancer.
bool is_precomputed(const std::string& output);

/// Throws Error(kUsage) where such an output is not made from a folder of pieces, or options do not fit it.
void require_fit_of_pieces(const Settings& settings);

/// Makes the folder of pieces, or one .precomputed, if `command` writes one: a confined process cannot. Throws
/// Error(kOutput) where it cannot be made.
void make_block_folder(const Settings& settings, std::uint32_t command);

/// The folders that it made, each before those in it.
const std::vector<std::filesystem::path>& made_folders();

/// Removes those of them that are empty: a command that fails leaves none.
void remove_empty_folders();

/// Shares the blocks of the run with other processes. Once called, reconstruct writes folders only.
void share_blocks(BlockTasks& tasks);
bool has_other_processes();
/// Of these processes the first one prints, and writes the log.
void silence_others(Settings& settings);

/// Runs reconstruct block by block. Returns the exit code.
int run_blocks(const Settings& settings);

}  // namespace regionmesh::cli
