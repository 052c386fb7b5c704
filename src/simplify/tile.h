// One box's faces as a model of their own: taken out of a batch, decimated with the rim fixed, and ready to go back.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/simplify.h"
#include "simplify/boxed_faces.h"

namespace regionmesh {

/// Finds the numbers of a few among many: open addressing, by the low bits of a product.
class NumberTable {
public:
    void clear();
    /// The place of the number for a key; kNone in it where there is none yet.
    std::uint32_t& operator[](std::uint32_t key);

private:
    void grow();
    std::size_t find(std::uint32_t key) const;

    std::vector<KeyedIndex> items_;
    std::uint32_t used_ = 0;
};

/// Used for one box after the other, so that its arrays keep their room.
class Tile {
public:
    /// Takes the box's faces and its obstacles. Threads may do so for different boxes at the same time.
    void take_out(BoxedFaces& faces, std::uint32_t box);
    /// The faces taken out, along a curve, and the vertices that they share; rim is fixed.
    Mesh& mesh() { return mesh_; }
    /// Notes what is left of the box's own faces. The box may then be taken out again.
    void note_left(BoxedFaces& faces, std::uint32_t box);
    /// Appends it: corners that are rim have their numbers already.
    void put_back(Chunk& made) const;

    std::size_t left_faces() const { return left_faces_.size(); }
    /// Vertices that are not rim: as taken out, and those left.
    std::size_t inside_count() const { return inside_count_; }
    std::size_t left_inside() const { return left_vertices_.size(); }

private:
    void put_in(BoxedFaces& faces, std::uint32_t f);

    Mesh mesh_;
    std::size_t inside_count_ = 0;
    std::vector<std::uint32_t> locals_;  // batch numbers of its vertices
    NumberTable rim_;                    // batch numbers to those of its vertices
    std::vector<VertexId> sorted_;       // where the vertices went when the model was sorted
    std::vector<std::uint32_t> number_;  // by vertex of the model: of what is left
    std::vector<ChunkVertex> left_vertices_;
    std::vector<ChunkFace> left_faces_;  // corners: kRim and a number of the rim, or one of the vertices left
};

}  // namespace regionmesh
