// Measures of the lines.
#pragma once

#include "regionmesh/check.h"

namespace regionmesh {

LineReport measure_lines(const Mesh& mesh);

}  // namespace regionmesh
