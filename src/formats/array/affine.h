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

/// The place of the first sample, which lies `steps` spacings from the point `from` that the file names. Spacings are
/// the lengths of the columns, or those of `options`.
Vec3 first_sample(const Columns& columns, Vec3 from, Vec3 steps, const ReadOptions& options);

}  // namespace regionmesh::formats
