// What must stay as it is in a model that is not sound, so that the rest can be worked on.
#pragma once

#include <cstdint>

#include "regionmesh/check.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// What cannot change any more.
struct FixedPart {
    std::uint32_t vertices = 0;  // fixed
    std::uint32_t faces = 0;     // all of whose vertices are
};

/// Fixes the vertices whose stars are not generic, and the corners of faces that are degenerate or cross others.
/// Decimation and smoothing then add no violation: each certificate is about a star that is generic before and after,
/// and what stands fast beside it is compared with like any other face. Of the options it uses those about the
/// boundary, and the threads.
FixedPart fix_unsound(Mesh& mesh, const CheckOptions& options);

}  // namespace regionmesh
