// The affine map from indices of samples to space.
#pragma once

#include <array>
#include <filesystem>

#include "regionmesh/lattice.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Three columns to multiply (i, j, k) by.
using Columns = std::array<Vec3, 3>;

/// Splits an affine map into spacing and unit columns, which need not be orthogonal, and sets them and the origin in
/// `lattice`. `what` names the map in errors, `remedy` ends the error for a map that is singular or not finite.
void set_affine(const std::filesystem::path& path, const char* what, const char* remedy, const Columns& columns,
                Vec3 origin, Lattice& lattice);

/// For files that place a point of reference, from which the first sample lies `steps` spacings away: moves the origin
/// to where it is with the spacing of `options`, if they have one. Requires the spacing of the file in `lattice`.
void keep_steps(const ReadOptions& options, Vec3 steps, Lattice& lattice);

}  // namespace regionmesh::formats
