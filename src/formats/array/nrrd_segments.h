// Segments in the header of a .seg.nrrd file, as 3D Slicer writes them.
#pragma once

#include <cstdint>

#include "formats/array/array_file.h"
#include "formats/array/header_fields.h"

namespace regionmesh::formats {

/// Adds the names and colours of the segments in a layer. Segments of versions that wrote no label values are layers of
/// their own, with label 1.
void take_segments(const HeaderFields& values, std::uint32_t in_layer, ArrayFile& array);

}  // namespace regionmesh::formats
