// What regions are called, where the input or the user names them.
#pragma once

#include <map>
#include <string>

#include "regionmesh/label.h"

namespace regionmesh {

/// Names by input label, UTF-8, one line each, none empty. Labels need not occur in the volume or model; two may share
/// a name.
using LabelNames = std::map<InputLabel, std::string>;

}  // namespace regionmesh
