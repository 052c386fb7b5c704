// What is decided before the sections are read for the mesh: target, tiles and budget.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "regionmesh/reconstruct.h"
#include "simplify/tiles/tiles.h"
#include "stream/budget.h"
#include "stream/face_source.h"
#include "stream/target.h"

namespace regionmesh {

struct Plan {
    Target target;
    TilePlan tiles;
    Budget budget;
    std::optional<LabelOracle> oracle;  // from the first pass, if there was one
    bool is_decimating = false;
};

/// Throws Error(kInput) where --memory is not enough to read the input, which no count of faces changes.
void require_room_to_read(const SourceShape& shape, const ReconstructOptions& options);

/// `counted` is what the first pass over the input counted, if there was one; `window_strips` is the number of strips
/// that smoothing holds, 0 without smoothing. Throws Error(kInput) where --memory cannot be kept.
Plan make_plan(const SourceShape& shape, std::optional<FaceCount> counted, std::uint32_t window_strips,
               const ReconstructOptions& options);

/// The least --memory with which that is accepted. No faces of strips: they were not counted.
std::uint64_t least_memory(const SourceShape& shape, const std::vector<std::uint64_t>& strip_faces,
                           std::uint32_t window_strips, const ReconstructOptions& options);

/// Is there anything to decimate to?
bool is_decimating(const ReconstructOptions& options);

/// One face per sample in each strip: a guess where nothing was counted.
std::vector<std::uint64_t> guessed_strip_faces(const Lattice& lattice, Sweep sweep);

}  // namespace regionmesh
