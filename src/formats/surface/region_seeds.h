// Points inside regions and holes, for volume meshers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/surface/file_regions.h"
#include "surface/bodies.h"
#include "surface/file_view.h"

namespace regionmesh {

/// Throws Error(kOutput) where the boundary of a region has an open edge: its volume cannot be meshed.
void require_closed_regions(const FileView& view, const Bodies& bodies);

/// A body and a point inside it.
struct Seed {
    Label label;
    Vec3 point;
};

/// One seed for each body of a region, and for each hole: a body of background or exterior that regions enclose. Throws
/// Error(kOutput) where a body is too thin for a point inside.
struct Seeds {
    std::vector<Seed> regions, holes;
};
Seeds find_seeds(const FileView& view, const Bodies& bodies);

}  // namespace regionmesh
