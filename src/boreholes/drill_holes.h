// Drill holes: intervals of one label, and the points that represent them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "boreholes/kriging.h"
#include "boreholes/point_table.h"
#include "boreholes/table_labels.h"

namespace regionmesh::formats {

/// One row of a table of drill holes, or the part of it between two stations.
struct Interval {
    double x = 0, y = 0, top = 0;                   // the upper end; top and bottom are elevations
    double bottom_x = 0, bottom_y = 0, bottom = 0;  // the lower end
    double collar = 0;                              // elevation of the top of the hole, as far as this row says
    double from = 0;            // grows down the hole: a depth, or an elevation with its sign changed
    double length = 0;          // length of the interval in the table; elevations may be rounded again
    Vec3 upper{}, lower{};      // directions down the hole at both ends, of unit length; zero without a path
    bool is_at_collar = false;  // it begins where the hole begins
    std::uint32_t label = 0;    // index in TableLabels, or kNoLabel
    std::uint32_t hole = 0;     // index in DrillHoles::holes
    std::uint32_t row = 0;
};

struct DrillHoles {
    std::filesystem::path path;
    std::vector<HeightSample> collars;  // the top of each hole; after find_collars()
    std::vector<Interval> intervals;
    TextTable holes;          // names of holes; empty where the table has none
    bool is_by_name = false;  // intervals of one name are one hole; else those at one x, y
};

/// A table of drill holes, as read_hole_table() returns it.
struct HoleTable {
    DrillHoles holes;
    TableLabels labels;
    std::optional<double> metres;  // and warning: as in TetrahedraInfo
    std::string warning;
};

/// Sets `collars`, for holes that are vertical, and `is_at_collar` of their intervals.
void find_collars(DrillHoles& holes);

/// The mean distance, in x and y, from a place to the nearest other one; 0 where all are at one place.
double mean_distance(const std::vector<HeightSample>& places);

/// Throws Error(kInput) naming both rows where intervals of two labels at one x, y overlap by more than a twentieth of
/// the longer one. Smaller overlaps are accepted: nearly all are a boundary recorded twice, or a missing layer listed
/// with almost no thickness. Holes of the same name at two places are two holes.
void refuse_overlaps(const DrillHoles& holes, const TableLabels& labels);

/// Appends the points that represent the intervals, in their order: the centres of the fewest equal parts no longer
/// than `step`, or the middle of each interval without a step. A point gets the row of its interval and, as label, its
/// number in TableLabels. Throws Error(kInput) before it appends any where there would be more than kMostPoints.
void append_points(const DrillHoles& holes, std::optional<double> step, PointTable& table);

}  // namespace regionmesh::formats
