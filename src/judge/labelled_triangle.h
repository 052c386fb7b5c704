// A face by its positions.
#pragma once

#include <array>

#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct LabelledTriangle {
    std::array<Vec3, 3> at;
    std::array<Label, 2> labels;  // the normal points from the first to the second
};

}  // namespace regionmesh
