// The largest sizes that 32-bit ids, and what is packed into them, can hold. Each limit is defined here and nowhere
// else.
#pragma once

#include <cstdint>

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

/// Throws Error(kInput) if a mesh of this size is beyond the limits; `what` names it, such as "model.ply".
void require_mesh_size(const char* what, std::uint64_t vertices, std::uint64_t faces);

}  // namespace regionmesh
