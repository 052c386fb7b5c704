// The public headers of regionmesh::core. Files and their formats: regionmesh/formats.h. Functions may be called from
// several threads at a time, each with objects of its own; what is only read may be shared.
#pragma once

#include "regionmesh/array_sections.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/census.h"
#include "regionmesh/check.h"
#include "regionmesh/compare.h"
#include "regionmesh/error.h"
#include "regionmesh/improve.h"
#include "regionmesh/limits.h"
#include "regionmesh/mesh.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/prepare_sections.h"
#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/report.h"
#include "regionmesh/select_sections.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "regionmesh/smooth_lines.h"
#include "regionmesh/stop.h"
#include "regionmesh/voxelise.h"
