// Drill holes: intervals of one label, and the points that represent them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "boreholes/point_table.h"
#include "boreholes/table_labels.h"

namespace regionmesh::formats {

/// One row of a table of drill holes.
struct Interval {
    double x = 0, y = 0;
    double top = 0, bottom = 0;  // elevations, top > bottom
    double length = 0;           // of the numbers in the table; elevations may be rounded again
    std::uint32_t label = 0;     // of TableLabels
    std::uint32_t hole = 0;      // of DrillHoles::holes
    std::uint32_t row = 0;
};

struct DrillHoles {
    std::filesystem::path path;
    std::vector<Interval> intervals;
    TextTable holes;  // names of holes; empty where the table has none
};

/// Throws Error(kInput) naming both rows where intervals of two labels at one x, y overlap by more than a twentieth of
/// the longer one. Smaller overlaps are accepted: nearly all are a boundary recorded twice, or a missing layer listed
/// with almost no thickness. Holes of the same name at two places are two holes.
void refuse_overlaps(const DrillHoles& holes, const TableLabels& labels);

/// Appends the points that represent the intervals, in their order: the centres of the fewest equal parts no longer
/// than `step`, or the middle of each interval without a step. A point gets the row of its interval and, as label, its
/// number in TableLabels. Throws Error(kInput) before it appends any where there would be more than kMostPoints.
void append_points(const DrillHoles& holes, std::optional<double> step, PointTable& table);

}  // namespace regionmesh::formats
