// Joins squares of the sides of the box that lie deep inside one region (docs/explanation/tiles.md, "Caps").
#pragma once

#include <cstdint>
#include <span>

#include "regionmesh/lattice.h"
#include "surface/chunk.h"

namespace regionmesh {

struct CapOptions {
    Lattice lattice = {};           // whose samples are the corners of the squares
    double min_quality = 0;         // of the new faces, unless they have the shape of half a square of the lattice
    std::uint64_t least_faces = 0;  // that the chunk keeps
    std::uint32_t threads = 1;
};

/// Faces on the sides of the box of a volume whose squares are all plain; at most so many can go.
std::uint64_t most_cap_faces(const Lattice& lattice);

/// A square of a side of the box is plain if its corners, four neighbouring samples, have one label: two faces. Plain
/// squares are joined into larger ones of 2, 4 and 8 squares a side: a restricted quadtree, in which squares that share
/// a part of a side differ by a factor of two at most (Von Herzen and Barr 1987). All new faces lie where the old ones
/// did, and squares at the edges of the side, at other labels and at vertices that the chunk carries or leaves active
/// keep their corners. So the surface stays the same set of points, every line stays as it is, and the mesh conforms.
/// Returns by how many faces the chunk has become smaller. Requires faces made from sections: of tetrahedra with a
/// label each, two plain squares with a common side may have two labels.
std::uint64_t coarsen_caps(Chunk& chunk, std::span<const ChunkVertex> carried, const CapOptions& options);

}  // namespace regionmesh
