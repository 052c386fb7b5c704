// Names and colours of regions, given by the input or by the user.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "regionmesh/label.h"

namespace regionmesh {

/// Names by input label: UTF-8, one line each, none empty; write_mesh() turns others into such. A label need not occur
/// in the volume or mesh; two labels may have the same name.
using LabelNames = std::map<InputLabel, std::string>;

/// Colours by input label: sRGB, 0xRRGGBB. A label need not occur in the volume or mesh.
using LabelColours = std::map<InputLabel, std::uint32_t>;

}  // namespace regionmesh
