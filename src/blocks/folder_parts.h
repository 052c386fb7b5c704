// A complete folder of pieces, read block by block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "blocks/block_grid.h"
#include "blocks/join.h"
#include "mesh/mesh_part.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A complete folder, and where its pieces lie.
struct BlockFolder {
    std::filesystem::path path;
    Manifest manifest = read_complete_manifest(path);
    BlockGrid grid = piece_grid(manifest);
    PieceMap pieces = piece_map(manifest, path);

    /// Around what the mesh of a piece with this box contains once it is at its place.
    Box placed(const Box& box) const;
    /// Moves a mesh of faces of the pieces to its place.
    void place(Mesh& mesh) const;
};

/// The faces that touch a block. Vertices are numbered by their position: in the same order in all parts. `part` refers
/// to the folder.
Mesh read_part(const BlockFolder& folder, std::uint32_t block, MeshPart& part);

}  // namespace regionmesh
