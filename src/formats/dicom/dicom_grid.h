// The lattice on which the frames of a segmentation lie.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/dicom/dicom_file.h"
#include "regionmesh/lattice.h"

namespace regionmesh::formats {

/// Sections along the normal of the frames, row x column; the first one lies lowest. Sections may have no frame.
struct DicomGrid {
    Lattice lattice;
    std::vector<std::uint32_t> sections;  // by frame
};

/// The distance of sections is that of the positions: SpacingBetweenSlices where it agrees with them, else the smallest
/// step. One section is as thick as the file says, or as `spacing`.
/// Throws Error(kInput) that names the file and the first frame without a position, orientation or spacing, with
/// others than the first one, or more than a twentieth of the spacing off the grid. Requires a frame.
DicomGrid find_grid(const std::string& source, const DicomObject& object, std::span<const DicomFrame> frames,
                    const std::optional<Vec3>& spacing);

}  // namespace regionmesh::formats
