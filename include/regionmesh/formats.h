// The public headers of regionmesh::formats: reading volumes, tetrahedra and models, writing models and reports.
#pragma once

#include "regionmesh/blocks.h"
#include "regionmesh/label_names_file.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/output_file.h"
#include "regionmesh/page.h"
#include "regionmesh/read_layers.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/read_tetrahedra.h"
#include "regionmesh/write_ascii_stl.h"
#include "regionmesh/write_report.h"
#include "regionmesh/write_volume.h"
