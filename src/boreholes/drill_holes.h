// Drill holes: intervals of one label, and the points that stand for them.
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
    double length = 0;           // from the numbers of the table: elevations may be rounded once more
    std::uint32_t label = 0;     // of TableLabels
    std::uint32_t hole = 0;      // of DrillHoles::holes
    std::uint32_t row = 0;
};

struct DrillHoles {
    std::filesystem::path path;
    std::vector<Interval> intervals;
    TextTable holes;  // their names; none where the table has none
};

/// Throws, naming both rows, where intervals of two labels at one x, y overlap by more than a twentieth of the longer
/// one. Less is taken for what it nearly always is: a boundary read off twice, or a layer that is missing and is kept
/// in the list with next to no thickness. Holes of one name at two places are two holes.
void refuse_overlaps(const DrillHoles& holes, const TableLabels& labels);

/// Appends the points that stand for the intervals, in their order: the centres of as few equal parts as are no longer
/// than `step`, or the middle of each without one. Each gets its interval's row, and as label the number that
/// TableLabels gave it. Throws before it appends any where there would be more points than kMostPoints.
void append_points(const DrillHoles& holes, std::optional<double> step, PointTable& table);

}  // namespace regionmesh::formats
