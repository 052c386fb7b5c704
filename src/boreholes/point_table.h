// Tables of labelled points, or of drill holes with intervals.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "regionmesh/read_tetrahedra.h"

namespace regionmesh::formats {

/// The labelled points of a table, before there are tetrahedra.
struct PointTable {
    TetrahedraInfo info;
    LabelledPoints points;
    std::vector<std::uint32_t> rows;  // one per point; the header is row 1
};

/// Reads a table of points, or the points that represent the intervals of drill holes. Throws Error(kInput) that names
/// the row.
PointTable read_point_table(const std::filesystem::path& path, const TetrahedraOptions& options);

struct HoleTable;

/// Reads a table of drill holes; rows without a label become intervals with kNoLabel. Throws as read_point_table(), and
/// for a table of points.
HoleTable read_hole_table(const std::filesystem::path& path, const TetrahedraOptions& options);

}  // namespace regionmesh::formats
