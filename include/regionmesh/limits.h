// The largest sizes that 32-bit ids, and what is packed into them, can hold, and the memory that work may take. Each
// limit is defined here and nowhere else.
#pragma once

#include <cstdint>
#include <string>

#include "regionmesh/lattice.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Faces of a mesh: a corner packs a face id and one of its three places into 32 bits.
inline constexpr std::uint64_t kMostFaces = (std::uint64_t{1} << 30) - 1;

/// Vertices of a mesh: the highest 32-bit id means "none".
inline constexpr std::uint64_t kMostVertices = (std::uint64_t{1} << 32) - 1;

/// Points of tetrahedra: ranks begin at 0, and the highest 32-bit rank means "none"; one more is kept free so that a
/// count of points, and the rank after the last, fit too.
inline constexpr std::uint64_t kMostPoints = (std::uint64_t{1} << 32) - 2;

/// Samples of one section: the tables of a strip have six places for each, numbered in 32 bits.
inline constexpr std::uint64_t kMostSectionSamples = 700'000'000;

/// Smallest and largest spacing of samples, in the unit of the file. Costs of collapses are of the fourth power of a
/// length, in single precision: within these bounds they neither overflow, which would end decimation early, nor
/// vanish.
inline constexpr double kLeastLength = 1e-12, kMostLength = 1e8;

/// Largest coordinate of a model: it may have been made of the largest volume of the largest spacing. The smallest size
/// of one is kLeastLength.
inline constexpr double kMostExtent = 1e20;

/// Largest ratio of a coordinate, and of a spacing, to the smallest spacing. Numbers of 53 binary digits then resolve
/// 1/4096 of the smallest spacing everywhere in the volume.
inline constexpr double kMostSpacings = 0x1p40;

/// The least and the most metres that a unit of length may have. Files that say others are damaged, or mean another
/// thing.
inline constexpr double kLeastUnit = 1e-15, kMostUnit = 1e6;
constexpr bool is_unit_of_length(double metres) { return metres >= kLeastUnit && metres <= kMostUnit; }

/// Bytes that work is planned for where nothing else is asked.
inline constexpr std::uint64_t kDefaultMemory = std::uint64_t{2} << 30;

/// Throws Error(kInput) where spacing, origin or extent lie outside these bounds, or are no numbers, where a direction
/// is not of length 1, to a thousandth, and where there are no samples; `what` names the volume.
void require_lattice(const std::string& what, const Lattice& lattice);

/// The same for the bounding box of a model or of points that is not empty.
void require_extent(const std::string& what, const Box& box);

/// Throws Error(kInput) if the axes are in none of the three orders of a sweep; `what` names the volume.
void require_sweep(const std::string& what, const Sweep& sweep);

/// Throws Error(kInput) if a mesh of this size is beyond the limits; `what` names it, such as "model.ply".
void require_mesh_size(const char* what, std::uint64_t vertices, std::uint64_t faces);

}  // namespace regionmesh
