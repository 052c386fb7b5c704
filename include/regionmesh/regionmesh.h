// The public headers of regionmesh::core. Files and their formats: regionmesh/formats.h.
#pragma once

#include "regionmesh/census.h"
#include "regionmesh/check.h"
#include "regionmesh/compare.h"
#include "regionmesh/error.h"
#include "regionmesh/fix_unsound.h"
#include "regionmesh/memory.h"
#include "regionmesh/mesh.h"
#include "regionmesh/preserve_volume.h"
#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/report.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "regionmesh/tetrahedron_census.h"
#include "regionmesh/typical_edge.h"
#include "regionmesh/voxelise.h"
