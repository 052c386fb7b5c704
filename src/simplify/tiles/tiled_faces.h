// The faces of a chunk by tile, the halo of each tile, and the locked vertices, which no tile may change.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/radix_sort.h"
#include "simplify/tiles/tile_grid.h"
#include "surface/chunk.h"

namespace regionmesh {

/// A face belongs to the tile that its centroid lies in. A vertex is *locked* if it is carried, active or pinned, has
/// faces in two tiles, or is a corner of a face that reaches out of its tile. Such a face is in the *halo* of all other
/// tiles that it may reach into. Locked vertices are numbered in their order, the carried ones first: the numbers that
/// they have in the chunk made from the tiles.
class TiledFaces {
public:
    /// Passes: (1) by parts of faces, marks the tile of their vertices, and notes tiles and halo; (2) by parts, orders
    /// the faces by tile; (3) numbers the locked vertices. The result is the same for any number of threads.
    TiledFaces(const Chunk& chunk, std::span<const ChunkVertex> carried, const TileGrid& grid, std::uint32_t threads);

    const TileGrid& grid() const { return grid_; }
    const Chunk& chunk() const { return chunk_; }
    const ChunkVertex& vertex(std::uint32_t local) const { return vertex_of(chunk_, carried_, local); }

    std::span<const std::uint32_t> faces_of(std::uint32_t tile) const {
        return std::span(order_).subspan(start_[tile], start_[tile + 1] - start_[tile]);
    }
    /// Faces of other tiles, as the indices.
    std::span<const KeyedIndex> halo_of(std::uint32_t tile) const;

    bool is_locked(std::uint32_t local) const { return (place_[local] & kLocked) != 0; }
    std::uint32_t locked_number(std::uint32_t local) const { return place_[local] & ~kLocked; }
    /// Room for a number of each vertex that is not locked, kNone at first. Only the tile that it lies in may use it.
    std::uint32_t& place(std::uint32_t local) { return place_[local]; }
    /// The locked vertices that are not carried, in the order of their numbers.
    std::vector<ChunkVertex> locked_vertices() const;

    static constexpr std::uint32_t kLocked = 0x80000000u, kNone = kLocked - 1;

private:
    /// One part of the faces.
    struct Part {
        std::vector<std::uint32_t> places;  // of its faces by tile: counts first, then positions in order_
        std::vector<KeyedIndex> halo;
        std::uint32_t tile = kNone;  // of the last face assigned
        Box limits = {};             // of that tile
    };

    std::array<ChunkVertex, 3> corners(const ChunkFace& face) const {
        return {vertex(face.vertices[0]), vertex(face.vertices[1]), vertex(face.vertices[2])};
    }
    std::uint32_t part_end(std::uint32_t part) const;
    void assign(std::uint32_t f, Part& part);
    void mark(std::uint32_t local, std::uint32_t tile);
    void order_faces(std::vector<Part>& parts, std::uint32_t threads);
    void number_locked();

    const Chunk& chunk_;
    std::span<const ChunkVertex> carried_;
    const TileGrid& grid_;
    std::uint32_t part_faces_ = 0;
    std::vector<std::uint32_t> tile_of_face_;   // while they are ordered
    std::vector<std::uint32_t> start_, order_;  // faces by tile
    std::vector<KeyedIndex> halo_;              // tile and face
    std::vector<std::uint32_t> place_;          // by vertex: kLocked and its number, or room
};

}  // namespace regionmesh
