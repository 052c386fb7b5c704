// One opener a format; open_tetrahedra chooses among them.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "regionmesh/read_tetrahedra.h"

namespace regionmesh::formats {

/// What a table of points says, before there are tetrahedra.
struct PointTable {
    TetrahedraInfo info;
    LabelledPoints points;
    std::vector<std::uint32_t> rows;  // of each point; the header is row 1
};

/// A table of points, or of drill holes with intervals.
PointTable read_point_table(const std::filesystem::path& path, const TetrahedraOptions& options);

/// Points of a table, and their Delaunay tetrahedra, which regionmesh-delaunay makes.
std::unique_ptr<TetrahedronReader> open_points(PointTable table, const TetrahedraOptions& options);

/// A VTK unstructured grid of tetrahedra; its faces, lines and vertices are passed over.
std::unique_ptr<TetrahedronReader> open_vtu(const std::filesystem::path& path, const TetrahedraOptions& options);

/// A Gmsh mesh, MSH 2.2 or 4.1, as text or binary; its faces, lines and points are passed over.
std::unique_ptr<TetrahedronReader> open_msh(const std::filesystem::path& path, const TetrahedraOptions& options);

}  // namespace regionmesh::formats
