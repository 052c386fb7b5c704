// What the header of a binary STL says whose attributes are labels.
#pragma once

#include <string_view>

namespace regionmesh {

inline constexpr std::string_view kStlAttributes = " ATTRIBUTE=LABEL";

}  // namespace regionmesh
