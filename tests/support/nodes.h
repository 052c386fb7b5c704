// The nodes of a cell as places.
#pragma once

#include "cells/kuhn.h"
#include "regionmesh/vec3.h"

namespace regionmesh::test {

/// The node of the unit cell to which a step leads from its first one.
inline Vec3 node(Step step) { return {double(step & 1), double(step >> 1 & 1), double(step >> 2 & 1)}; }

}  // namespace regionmesh::test
