// Units of length by name.
#pragma once

#include <optional>
#include <string_view>

namespace regionmesh::formats {

/// The femtometres of a unit: "millimeter" as UDUNITS-2 calls it, "millimetre", "millimeters", "mm" and so on. Whole
/// numbers, so that their ratios are exact. None for another word.
std::optional<double> femtometres_in(std::string_view unit);

/// The metres of a unit. None for another word.
std::optional<double> metres_in(std::string_view unit);

/// Of the one unit that a list of units in quotes names, as `"mm" "mm" ""`; none where there are several or none.
std::optional<double> metres_in_quoted(std::string_view units);

}  // namespace regionmesh::formats
