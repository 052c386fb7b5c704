// Paths of inclined holes: collars and surveys.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "boreholes/drill_holes.h"
#include "boreholes/table_columns.h"
#include "regionmesh/vec3.h"

namespace regionmesh::formats {

/// The direction of a hole at a depth along it.
struct Station {
    double depth = 0;
    Vec3 direction{0, 0, -1};  // unit vector down the hole
};

/// The course of one hole: by the method of minimum curvature, an arc of a circle between two stations to which the
/// directions at both are tangent. Straight above the first station and below the last.
class HolePath {
public:
    /// Requires stations in order of depth, at least one, at depths of 0 or more.
    HolePath(Vec3 collar, std::vector<Station> stations);

    Vec3 at(double depth) const;
    /// Unit vector down the hole.
    Vec3 direction_at(double depth) const;
    const std::vector<Station>& stations() const { return stations_; }

private:
    std::vector<Station> stations_;
    std::vector<Vec3> places_;  // positions of the stations
};

/// The paths of holes by name.
using HolePaths = std::map<std::string, HolePath, std::less<>>;

/// Reads a table of collars with columns hole, x, y and surface (or z, elevation, collar), or those that pairs in
/// `columns` name, TetrahedraOptions::columns; and one of stations with
/// columns hole, depth, azimuth (degrees from north to east) and dip (degrees from the horizontal; where most of the
/// table are negative, negative is down, else positive is) or inclination (degrees from straight down). Holes without
/// stations, or without a table of stations, are vertical. Throws Error(kInput) naming file and row; also for a dip
/// outside -90 to 90, an inclination outside 0 to 180, and opposite directions at two stations, between which there is
/// no one arc. Adds the titles of lengths to `unit`.
HolePaths read_hole_paths(const std::filesystem::path& collars, const std::filesystem::path& surveys,
                          const std::string& columns, TitleUnit& unit);

/// Cuts intervals at stations and puts their ends where the paths lead; before, `from` and `length` are depths along
/// the hole. Sets the collars and `is_at_collar`. Throws Error(kInput) naming the row of a hole without a collar, or
/// one at which overlaps make 16 times as many parts as there are intervals and stations.
void place_on_paths(DrillHoles& holes, const HolePaths& paths);

}  // namespace regionmesh::formats
