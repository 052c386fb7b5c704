// Merges chunks into the model, and knows which vertices are active.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "simplify/tiles/mesh_chunk.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Active vertices may still receive faces; the others are finalized (P 3.3, 3.4). A chunk names its carried vertices
/// by their order among the active ones, so that merging is a look-up, never a distance test. Chunks stay as they came
/// until all are there, or the model has to shrink: nothing reads the stars of vertices before, and a chunk has 36
/// bytes a face, a mesh 48.
class Merger {
public:
    /// Requires chunks in the order in which they were made, the first of which carries nothing. Throws Error(kInput)
    /// beyond the limits of limits.h.
    void add(Chunk chunk);

    std::uint64_t face_count() const { return count(chunks_).faces; }
    std::uint32_t active_count() const;
    /// Bytes of vertices and faces.
    std::size_t bytes() const;

    /// The model as one chunk, which may be added again. Empties the merger.
    Chunk take_chunk();
    /// The model as a mesh, whose active vertices are fixed. Empties the merger.
    Mesh take_mesh();
    /// The same, sorted (Mesh::sort_spatially). It may be put back.
    Mesh take_sorted_mesh(std::uint32_t threads);
    /// Requires that no active vertex was removed. Empties the mesh.
    void put_back(Mesh& mesh);

private:
    std::vector<Chunk> chunks_;
    std::vector<VertexId> active_;  // of the mesh that may be put back
};

/// Unpins all vertices, after the last chunk. Returns how many were pinned.
std::uint64_t release_all(Mesh& mesh);

}  // namespace regionmesh
