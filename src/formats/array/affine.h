// The map from indices of samples to space, as the headers of volumes write it.
#pragma once

#include <array>
#include <filesystem>

#include "regionmesh/lattice.h"

namespace regionmesh::formats {

/// Three columns to multiply (i, j, k) by.
using Columns = std::array<Vec3, 3>;

/// Splits an affine map into lengths and unit columns, which need not be orthogonal, and puts them into `lattice` with
/// the origin. `what` is what the header calls the map, `remedy` ends the error for one that is singular or not finite.
void set_affine(const std::filesystem::path& path, const char* what, const char* remedy, const Columns& columns,
                Vec3 origin, Lattice& lattice);

}  // namespace regionmesh::formats
