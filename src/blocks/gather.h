// Between pieces and the chunks that are simplified.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "blocks/block_grid.h"
#include "blocks/piece.h"
#include "blocks/piece_map.h"
#include "blocks/simplify_block.h"

namespace regionmesh {

/// The block that a face belongs to: that of its centroid. Depends on the corners as a set only.
std::uint32_t block_of(const BlockGrid& grid, const std::array<Vec3, 3>& corners);

/// The same of a chunk that carries no vertices.
std::uint32_t block_of(const BlockGrid& grid, const Chunk& chunk, const ChunkFace& face);

/// The bits of the coordinates, the same for 0 and -0: positions that are equal have equal bits.
using PositionBits = std::array<std::uint64_t, 3>;
PositionBits bits_of(Vec3 position);
struct PositionHash {
    std::size_t operator()(const PositionBits& bits) const;
};

/// Numbers of vertices that several pieces may have, by their exact position.
class SharedVertices {
public:
    /// The number of the position; `next`, which is noted, where it is new.
    std::uint32_t number(Vec3 position, std::uint32_t next);

private:
    std::unordered_map<PositionBits, std::uint32_t, PositionHash> numbers_;
};

/// The faces of a block, out of the pieces of another plan of blocks.
class BlockGatherer {
public:
    BlockGatherer(const BlockGrid& grid, std::uint32_t block)
        : grid_(grid), block_(block), limits_(grid.limits(block)), reach_(grid.reach(block)) {}

    /// Adds the faces of a piece that belong to the block or touch it; pieces outside of BlockGrid::reach() have none.
    /// Pieces come in the order of their numbers. `keep` is the share of this piece's faces that the
    /// goal has room for. `taken`, if given, gets the numbers in the piece of the faces that were added.
    void add(const Piece& piece, double keep, std::vector<std::uint32_t>* taken = nullptr);
    /// The sum over the block's own faces of the shares to keep.
    double goal() const { return goal_; }
    /// The faces, with the locked vertices as active ones: those of faces of other blocks, and corners of faces that
    /// reach out of the block.
    void take(BlockChunk& block);

private:
    std::uint32_t number(const PieceVertex& vertex, std::uint32_t& place);

    const BlockGrid& grid_;
    std::uint32_t block_;
    Box limits_, reach_;
    Chunk chunk_;
    SharedVertices shared_;
    std::vector<bool> is_locked_;
    std::uint64_t other_faces_ = 0;
    double goal_ = 0;
};

/// All blocks, those first that have most faces in the pieces round them: they take longest, and ranks then end at
/// about the same time.
std::vector<std::uint32_t> longest_first(const BlockGrid& blocks, const PieceMap& map,
                                         std::span<const PieceHeader> pieces);

/// The block's own faces of a chunk as a piece; its vertices are in order of first use. Vertices that are locked, or on
/// faces of other blocks, are shared.
Piece piece_of(const BlockChunk& block, const BlockGrid& grid, const PieceHeader& header);

}  // namespace regionmesh
