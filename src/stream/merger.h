// Merges chunks into the mesh, and knows which vertices are active.
#pragma once

#include <vector>

#include "mesh/chunk.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Active vertices may still receive faces and are fixed in the mesh; the others are finalized (P 3.3, 3.4). A chunk
/// names its carried vertices by their order among the active ones, so that merging is a look-up, never a distance
/// test.
class Merger {
public:
    explicit Merger(Mesh& mesh) : mesh_(mesh) {}

    /// Requires chunks in the order in which they were made, and that no active vertex was removed from the mesh.
    void add(const Chunk& chunk);

    std::uint32_t active_count() const { return static_cast<std::uint32_t>(active_.size()); }

    /// The whole mesh as one chunk, which may be added again. Empties the mesh.
    Chunk take_apart();

    /// The vertices of the mesh have new ids (Mesh::sort_spatially).
    void renumber(const std::vector<VertexId>& new_ids);

    /// Unpins all vertices, after the last chunk. Returns how many were pinned.
    std::uint64_t release_all();

private:
    Mesh& mesh_;
    std::vector<VertexId> active_;
    std::vector<VertexId> ids_;  // mesh ids of the vertices of a chunk
};

}  // namespace regionmesh
