// The faces of a batch by the box that they lie in, and the rim: what no box may change.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/radix_sort.h"
#include "mesh/chunk.h"
#include "simplify/box_grid.h"

namespace regionmesh {

/// A face belongs to the box that its middle lies in. A vertex is *rim* where it is carried, open, of faces of more
/// than one box, or of a face that reaches out of its box. Such a face is an *obstacle* in all boxes it may reach into.
/// Rim vertices are numbered in their order, the carried ones first: so they will be in the batch that is made.
class BoxedFaces {
public:
    /// Passes: (1) by parts of faces, marks what their vertices belong to, and notes boxes and obstacles; (2) by
    /// parts, puts the faces in the order of boxes; (3) numbers the rim. The same for any number of threads.
    BoxedFaces(const Chunk& batch, std::span<const ChunkVertex> carried, const BoxGrid& grid, std::uint32_t threads);

    const BoxGrid& grid() const { return grid_; }
    const Chunk& batch() const { return batch_; }
    const ChunkVertex& vertex(std::uint32_t local) const {
        return local < batch_.carried ? carried_[local] : batch_.vertices[local - batch_.carried];
    }

    std::span<const std::uint32_t> faces_of(std::uint32_t box) const {
        return std::span(order_).subspan(start_[box], start_[box + 1] - start_[box]);
    }
    /// Faces of other boxes, as the indices.
    std::span<const KeyedIndex> obstacles_of(std::uint32_t box) const;

    bool is_rim(std::uint32_t local) const { return (place_[local] & kRim) != 0; }
    std::uint32_t rim_number(std::uint32_t local) const { return place_[local] & ~kRim; }
    /// Room for a number of each vertex that is not rim, kNone at first. Only the box that it lies in may use it.
    std::uint32_t& place(std::uint32_t local) { return place_[local]; }
    /// The vertices of the rim that are not carried, in the order of their numbers.
    std::vector<ChunkVertex> rim_vertices() const;

    static constexpr std::uint32_t kRim = 0x80000000u, kNone = kRim - 1;

private:
    /// What a part of faces has brought.
    struct Part {
        std::vector<std::uint32_t> places;  // of its faces by box: counts, then where they go
        std::vector<KeyedIndex> obstacles;
    };

    std::array<ChunkVertex, 3> corners(const ChunkFace& face) const {
        return {vertex(face.vertices[0]), vertex(face.vertices[1]), vertex(face.vertices[2])};
    }
    std::uint32_t part_end(std::uint32_t part) const;
    void look_at(std::uint32_t f, Part& part);
    void mark(std::uint32_t local, std::uint32_t box);
    void order_faces(std::vector<Part>& parts, std::uint32_t threads);
    void number_rim();

    const Chunk& batch_;
    std::span<const ChunkVertex> carried_;
    const BoxGrid& grid_;
    std::uint32_t part_faces_ = 0;
    std::vector<std::uint32_t> box_of_face_;    // while they are ordered
    std::vector<std::uint32_t> start_, order_;  // faces by box
    std::vector<KeyedIndex> obstacles_;         // box and face
    std::vector<std::uint32_t> place_;          // by vertex: kRim and its number, or room
};

}  // namespace regionmesh
