// What regionmesh-dicom sends of a frame, and regionmesh takes.
#pragma once

#include <array>

namespace regionmesh::formats {

/// What a frame's functional groups, or those that all frames share, say; not a number where they do not.
struct DicomFrame {
    double segment;
    std::array<double, 3> position;       // LPS, in mm, of the first sample
    std::array<double, 6> orientation;    // unit vectors along a row, and along a column
    std::array<double, 2> pixel_spacing;  // mm between rows, between columns
    double between_slices, thickness;     // mm
};
static_assert(sizeof(DicomFrame) == 14 * sizeof(double), "sent as it lies in memory");

}  // namespace regionmesh::formats
