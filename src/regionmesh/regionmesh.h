// Everything public.
#pragma once

#include "regionmesh/base/error.h"
#include "regionmesh/check/check.h"
#include "regionmesh/compare/compare.h"
#include "regionmesh/decimate/decimate.h"
#include "regionmesh/io/model_file.h"
#include "regionmesh/io/output_file.h"
#include "regionmesh/io/read_sections.h"
#include "regionmesh/io/write_compare.h"
#include "regionmesh/io/write_report.h"
#include "regionmesh/model/model.h"
#include "regionmesh/model/typical_edge.h"
#include "regionmesh/pipeline.h"
#include "regionmesh/report.h"
#include "regionmesh/smooth/smooth.h"
