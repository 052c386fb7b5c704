// Where a DREAM.3D file keeps its volume.
#pragma once

#include "formats/chunked/hdf5_volume.h"

namespace regionmesh::formats {

/// The cell array FeatureIds, or else GrainIds, of the only image geometry that has one, or the array that `inside`
/// names. Image geometries are /DataContainers/NAME/_SIMPL_GEOMETRY (DREAM.3D 6, file version 7) or groups below
/// /DataStructure with the attribute _DIMENSIONS (DREAM3D-NX, file version 8). Nothing where the file is not
/// DREAM.3D's, or `inside` lies in none of its image geometries. The first sample lies in the middle of the first cell,
/// half a spacing from the geometry's origin. Throws where there are several such arrays, naming them, or none.
std::optional<Hdf5Volume> find_dream3d_volume(Hdf5Reader& file, const std::string& inside);

}  // namespace regionmesh::formats
