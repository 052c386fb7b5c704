// Pieces as one model.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "blocks/manifest.h"
#include "blocks/piece.h"
#include "blocks/piece_map.h"

namespace regionmesh {

/// Reads all of a finished run. Throws Error(kInput) if labels or pieces are missing or are not those that it made.
void require_pieces(const Manifest& manifest, const std::filesystem::path& folder);

/// The file of a piece: "pass-0-000017.piece".
std::filesystem::path piece_path(const std::filesystem::path& folder, std::uint32_t pass, std::uint32_t block);

/// The pass of a file with such a name.
std::optional<std::uint32_t> pass_of(const std::string& name);

/// What the pieces of a surveyed run have in common.
PieceLimits piece_limits(const Manifest& manifest);

/// Reads a piece of the manifest, which also has its checksum.
Piece read_entry(const Manifest& manifest, const std::filesystem::path& folder, std::uint32_t block);

/// Vertices of the whole model: those that several pieces share are counted once.
std::uint64_t count_vertices(const Manifest& manifest, const std::filesystem::path& folder);

/// The header of such a piece. Looks at the checksum that its file says, and not at the rest.
PieceHeader read_entry_header(const Manifest& manifest, const std::filesystem::path& folder, std::uint32_t block);

/// Where the pieces lie. Reads their headers.
PieceMap piece_map(const Manifest& manifest, const std::filesystem::path& folder);

}  // namespace regionmesh
