// Joins batches of faces to the model, and knows which vertices are the front.
#pragma once

#include <vector>

#include "mesh/chunk.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Vertices of the front still miss faces and are fixed in the model; the others are finalized (P 3.3, 3.4). A batch
/// names its carried vertices by their order in the front, so that welding is a look-up, never a distance test.
class Weld {
public:
    explicit Weld(Mesh& mesh) : mesh_(mesh) {}

    /// Requires batches in the order in which they were made, and that no front vertex was removed from the model.
    void add(const Chunk& batch);

    /// The vertices that the next batch carries.
    std::vector<ChunkVertex> front() const;

    /// The whole model as one batch, which may be added again: its open vertices are the front. Empties the model.
    Chunk take_apart();

    /// The vertices of the model have new ids (Mesh::sort_spatially).
    void renumber(const std::vector<VertexId>& new_ids);

    /// When all is welded: nothing is pinned any more. Returns how many vertices were.
    std::uint64_t release_all();

private:
    Mesh& mesh_;
    std::vector<VertexId> front_;
    std::vector<VertexId> ids_;  // model ids of the batch's vertices
};

}  // namespace regionmesh
