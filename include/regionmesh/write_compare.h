// The JSON of a comparison.
#pragma once

#include <string>

#include "regionmesh/compare.h"

namespace regionmesh {

/// JSON text as of report_json; docs/compare.md lists the keys. Regions, interfaces and lines stand in order of label,
/// a number in the signedness of the input; the exterior is labels.exterior_label(), and stands last in a list. What
/// only one model has is null for the other, and so are the distances; `only_in_a` and `only_in_b` name it.
std::string compare_json(const CompareReport& report);

}  // namespace regionmesh
