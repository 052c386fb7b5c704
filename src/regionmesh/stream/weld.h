// Joins batches of faces to the model, and knows which vertices are the front.
#pragma once

#include <vector>

#include "regionmesh/model/model.h"
#include "regionmesh/tets/face_batch.h"

namespace regionmesh {

/// Vertices of the front still miss faces and are fixed in the model; the others are finalized (P 3.3, 3.4). A batch
/// names its carried vertices by their order in the front, so that welding is a look-up, never a distance test.
class Weld {
public:
    explicit Weld(Model& model) : model_(model) {}

    /// Requires batches in the order in which they were made, and that no front vertex was removed from the model.
    void add(const FaceBatch& batch);

    /// The vertices that the next batch carries.
    std::vector<BatchVertex> front() const;

    /// The whole model as one batch, which may be added again: its open vertices are the front. Empties the model.
    FaceBatch take_apart();

    /// The vertices of the model have new ids (Model::sort_spatially).
    void renumber(const std::vector<VertexId>& new_ids);

    /// When all is welded: nothing is pinned any more. Returns how many vertices were.
    std::uint64_t release_all();

private:
    Model& model_;
    std::vector<VertexId> front_;
    std::vector<VertexId> ids_;  // model ids of the batch's vertices
};

}  // namespace regionmesh
