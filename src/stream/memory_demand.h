// What a run asks of memory, from its options.
#pragma once

#include "regionmesh/reconstruct.h"
#include "stream/face_source.h"
#include "stream/memory_plan.h"
#include "stream/target.h"

namespace regionmesh {

/// What is known of a run before it begins.
struct RunSize {
    const SourceShape& shape;
    std::vector<std::uint64_t> strip_faces;  // counted; empty: nobody has
    std::uint32_t window_strips;             // of smoothing
    std::uint32_t run_strips;                // of the tile plan; or welded at a time
};

/// Is there anything to decimate to?
bool is_decimating(const ReconstructOptions& options);

MemoryDemand memory_demand(const ReconstructOptions& options, const Target& target, RunSize size);

}  // namespace regionmesh
