// The chunks of a surface that smoothing holds at a time, as flat arrays.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sliding_array.h"
#include "base/sliding_lists.h"
#include "regionmesh/mesh.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Numbers from `first` up to `end`, without it.
struct NumberRange {
    std::uint32_t first = 0, end = 0;
    std::uint32_t size() const { return end - first; }
};

/// Chunks are numbered from 0 in the order in which they are added, and so are all their vertices and faces. A face has
/// vertices of its own chunk and the one before, so that all faces of a vertex lie in its chunk and the next. A surface
/// that is wholly in core is one chunk.
class SurfaceWindow {
public:
    SlidingArray<Vec3> origin;  // positions before smoothing
    SlidingArray<SideSet> sides;
    SlidingArray<ChunkFace> faces;  // faces with vertex numbers of the window: a neighbour is found with one look-up

    SurfaceWindow();

    /// Appends the chunk that follows. Throws Error(kInput) where a surface has 2^32 faces or vertices.
    void add(const Chunk& chunk);
    /// Appends the vertices and faces of a mesh as a chunk, in their order. Fixed vertices are marked as lying on all
    /// sides of the box, so that they stay. Returns the number in the window of each vertex of the mesh.
    std::vector<std::uint32_t> add(const Mesh& mesh);
    /// A chunk as it was added, but with its vertices at `positions`.
    void copy_out(std::uint32_t chunk, const SlidingArray<Vec3>& positions, Chunk& out) const;

    std::uint32_t chunk_end() const { return starts_.end() - 1; }
    NumberRange vertices_of(std::uint32_t chunk) const { return {starts_[chunk].vertex, starts_[chunk + 1].vertex}; }
    NumberRange faces_of(std::uint32_t chunk) const { return {starts_[chunk].face, starts_[chunk + 1].face}; }

    /// Releases the chunks before this one; vertices of the last of them stay for the faces that use them.
    void drop_before(std::uint32_t chunk);
    std::size_t bytes() const { return origin.bytes() + sides.bytes() + faces.bytes() + active_.bytes(); }

private:
    struct Start {
        std::uint32_t vertex, face;
    };

    /// Vertices that chunk n carries: those left active by the chunk before.
    std::span<const std::uint32_t> carried_by(std::uint32_t chunk) const;
    void end_chunk(std::span<const std::uint32_t> active);

    SlidingArray<Start> starts_;  // starts of each chunk, and of the next one
    SlidingLists active_;         // vertices that each chunk leaves active
};

}  // namespace regionmesh
