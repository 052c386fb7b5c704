// Colours of regions for pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/file_view.h"

namespace regionmesh {

/// A colour as 0xRRGGBB (sRGB) for each place of FileView::ordered_labels(). Regions with a common interface get
/// different colours of a fixed palette, as far apart as possible for normal, protanopic and deuteranopic eyes. Depends
/// on the mesh and the labels only.
std::vector<std::uint32_t> region_colours(const FileView& view);

}  // namespace regionmesh
