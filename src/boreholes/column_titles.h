// Titles that identify a column of a table, as plain_column_title() returns them, the most likely first. Those of AGS,
// the exchange format of ground investigation, begin with the name of its group: LOCA_NATE.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

namespace regionmesh::formats {

using Titles = std::span<const std::string_view>;

namespace titles {

inline constexpr std::string_view kX[]{"x", "easting", "east", "xcollar", "locanate", "holenate"};
inline constexpr std::string_view kY[]{"y", "northing", "north", "ycollar", "locanatn", "holenatn"};
inline constexpr std::string_view kZ[]{"z"};
inline constexpr std::string_view kElevation[]{"elevation", "elev", "rl"};
inline constexpr std::string_view kSurface[]{"surface", "collar",  "elevation", "elev",  "altitude",
                                             "rl",      "zcollar", "locagl",    "holegl"};
inline constexpr std::string_view kHole[]{"hole", "holeid", "bhid", "borehole", "well", "locaid"};
inline constexpr std::string_view kName[]{"name"};
inline constexpr std::string_view kLabel[]{"label", "lithology", "lith",     "litho",  "formation",
                                           "unit",  "rock",      "geolgeol", "geolleg"};
inline constexpr std::string_view kTop[]{"top", "from", "depthfrom", "geoltop"};
inline constexpr std::string_view kBottom[]{"bottom", "base", "to", "depthto", "geolbase"};
inline constexpr std::string_view kDepth[]{"depth", "md", "at", "distance", "from"};
inline constexpr std::string_view kAzimuth[]{"azimuth", "azi", "az", "bearing", "brg"};
inline constexpr std::string_view kInclination[]{"inclination", "inc", "incl"};
inline constexpr std::string_view kDip[]{"dip"};

}  // namespace titles

}  // namespace regionmesh::formats
