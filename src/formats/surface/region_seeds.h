// What volume meshers are told of a model: its bodies in groups, holes, and points inside.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/surface/file_regions.h"
#include "mesh/bodies.h"
#include "mesh/file_view.h"

namespace regionmesh {

/// Throws Error(kOutput) where a region has a boundary with an open edge: nothing can mesh its volume.
void require_closed_regions(const FileView& view, const Bodies& bodies);

/// A body and a point inside it.
struct Seed {
    Label label;
    Vec3 point;
};

/// One seed for each body of a region, and one for each body of background or exterior that regions enclose (a hole).
/// Throws Error(kOutput) where a body is too thin to have one.
struct Seeds {
    std::vector<Seed> regions, holes;
};
Seeds find_seeds(const FileView& view, const Bodies& bodies);

}  // namespace regionmesh
