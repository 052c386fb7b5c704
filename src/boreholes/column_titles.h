// Titles that identify a column of a table, as plain_column_title() returns them, the most likely first.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

namespace regionmesh::formats {

using Titles = std::span<const std::string_view>;

namespace titles {

inline constexpr std::string_view kX[]{"x", "easting", "east", "xcollar"};
inline constexpr std::string_view kY[]{"y", "northing", "north", "ycollar"};
inline constexpr std::string_view kZ[]{"z"};
inline constexpr std::string_view kElevation[]{"elevation", "elev", "rl"};
inline constexpr std::string_view kSurface[]{"surface", "collar", "elevation", "elev", "altitude", "rl", "zcollar"};
inline constexpr std::string_view kHole[]{"hole", "holeid", "bhid", "borehole", "well"};
inline constexpr std::string_view kName[]{"name"};
inline constexpr std::string_view kLabel[]{"label", "lithology", "lith", "litho", "formation", "unit", "rock"};
inline constexpr std::string_view kTop[]{"top", "from", "depthfrom"};
inline constexpr std::string_view kBottom[]{"bottom", "base", "to", "depthto"};
inline constexpr std::string_view kDepth[]{"depth", "md", "at", "distance", "from"};
inline constexpr std::string_view kAzimuth[]{"azimuth", "azi", "az", "bearing", "brg"};
inline constexpr std::string_view kInclination[]{"inclination", "inc", "incl"};
inline constexpr std::string_view kDip[]{"dip"};

}  // namespace titles

}  // namespace regionmesh::formats
