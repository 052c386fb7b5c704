// Measures of a model at its edges: curvature of interfaces, lengths and angles of lines.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mesh/file_view.h"

namespace regionmesh {

/// Of the faces between two labels; `curvature` is the integral of the mean curvature over them, positive where the
/// first label is convex. Faces on the exterior have none.
struct InterfaceMeasures {
    std::uint64_t faces = 0;
    double area = 0, curvature = 0;
    Vec3 moment{};           // integral of the position over the area
    double line_length = 0;  // of the lines that bound it
};

/// Of the edges at which the same three labels or more meet.
struct LineMeasures {
    std::uint64_t edges = 0;
    double length = 0;
    std::vector<double> angles;  // by label: integral of its dihedral angle over angle_length, in radians
    std::vector<double> angle_length;
};

/// Keys are places in the order of files (FileView::rank), ascending; the whole exterior is kFirstExterior.
struct EdgeMeasures {
    std::map<std::array<std::uint32_t, 2>, InterfaceMeasures> interfaces;
    std::map<std::vector<std::uint32_t>, LineMeasures> lines;
};

/// Without faces and lines that have no other labels than background and exterior.
/// Dihedral angles of lines (LineAngles) take most of the time, and are left out unless they are wanted.
EdgeMeasures measure_edges(const FileView& view, bool has_angles = false);

}  // namespace regionmesh
