// Values that only the input explains: names of labels, and lengths with a unit.
#pragma once

#include <string>

#include "regionmesh/options.h"

namespace regionmesh {

/// Whether `text` has a name where the option takes labels, or a unit where it takes a length.
bool is_deferred(const OptionSpec& option, const std::string& text);

}  // namespace regionmesh
