// The faces of one tile as a mesh of their own: taken out of a chunk, simplified with locked vertices fixed, put back.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/simplify.h"
#include "simplify/tiles/tiled_faces.h"

namespace regionmesh {

/// Numbers of a few keys out of many: a hash table with open addressing.
class NumberTable {
public:
    void clear();
    /// The number of a key, to read or set; kNone at first.
    std::uint32_t& operator[](std::uint32_t key);

private:
    void grow();
    std::size_t find(std::uint32_t key) const;

    std::vector<KeyedIndex> items_;
    std::uint32_t used_ = 0;
};

/// Used for one tile after the other, so that its arrays keep their room, but for the mesh.
class Tile {
public:
    /// Takes the faces of the tile and its halo. Threads may do so for different tiles at the same time.
    void take_out(TiledFaces& faces, std::uint32_t tile);
    /// The faces taken out, along a curve, and their vertices; locked ones are fixed.
    Mesh& mesh() { return mesh_; }
    /// Notes which of the tile's own faces are left, and empties the mesh. The tile may then be taken out again.
    void note_left(TiledFaces& faces, std::uint32_t tile);
    /// Appends them to a chunk that begins with the locked vertices.
    void put_back(Chunk& made) const;

    /// Vertices that are not locked: taken out, and left.
    std::size_t inside_count() const { return inside_count_; }

private:
    void put_in(TiledFaces& faces, std::uint32_t f, Mesh::Arrays& arrays);

    Mesh mesh_;
    std::size_t inside_count_ = 0;
    std::vector<std::uint32_t> locals_;  // chunk numbers of its vertices
    NumberTable locked_;                 // chunk numbers to those of its vertices
    std::vector<VertexId> sorted_;       // ids of the vertices after the mesh was sorted
    std::vector<std::uint32_t> number_;  // by vertex of the mesh: its number among those left
    std::vector<ChunkVertex> left_vertices_;
    struct LockedBound {
        std::uint32_t number;
        float bound;
    };
    std::vector<LockedBound> left_bounds_;  // error bounds of locked vertices that rose
    std::vector<ChunkFace> left_faces_;     // corners: kLocked and a locked number, or a number in left_vertices_
};

}  // namespace regionmesh
