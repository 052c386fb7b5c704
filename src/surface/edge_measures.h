// Measures of a model at its edges: curvature of interfaces, lengths and angles of lines.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "surface/file_view.h"

namespace regionmesh {

/// Measures of the faces between two labels.
struct InterfaceMeasures {
    std::uint64_t faces = 0;
    double area = 0;
    /// The integral of the mean curvature, positive where the first label is convex, over the part of the interface
    /// that is more than one edge away from lines, and the area of that part. Faces on the exterior have none.
    double curvature = 0, curved_area = 0;
    Vec3 moment{};           // integral of the position over the area
    double line_length = 0;  // length of the lines that bound it

    std::optional<double> mean_curvature() const {
        return curved_area > 0 ? std::optional(curvature / curved_area) : std::nullopt;
    }
};

/// Measures of the edges at which the same three labels or more meet.
struct LineMeasures {
    std::uint64_t edges = 0;
    double length = 0;
    std::vector<double> angles;  // one per label: integral of its dihedral angle over angle_length, in radians
    std::vector<double> angle_length;
};

/// Keys are ranks in the order of files (FileView::rank), ascending; the whole exterior is kFirstExterior.
struct EdgeMeasures {
    std::map<std::array<std::uint32_t, 2>, InterfaceMeasures> interfaces;
    std::map<std::vector<std::uint32_t>, LineMeasures> lines;
};

/// No faces and lines that have no other labels than background and exterior.
/// Dihedral angles of lines (LineAngles) take most of the time, and are left out unless they are wanted.
EdgeMeasures measure_edges(const FileView& view, bool has_angles = false);

}  // namespace regionmesh
