// Finds the volume of a DREAM.3D file.
#pragma once

#include "formats/chunked/hdf5_volume.h"

namespace regionmesh::formats {

/// The array that `inside` names, else the cell array FeatureIds, else GrainIds, of the only image geometry that has
/// one. Image geometries are /DataContainers/NAME/_SIMPL_GEOMETRY (DREAM.3D 6, file version 7) or groups below
/// /DataStructure with the attribute _DIMENSIONS (DREAM3D-NX, file version 8). Nothing if the file is no DREAM.3D file,
/// or `inside` lies in none of its image geometries. The first sample lies in the middle of the first cell, half a
/// spacing from the origin of the geometry. Throws if there are no such arrays or several, which are named.
std::optional<Hdf5Volume> find_dream3d_volume(Hdf5Reader& file, const std::string& inside);

}  // namespace regionmesh::formats
