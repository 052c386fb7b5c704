// Chunks of a lattice's surface in few bytes, for the time in which no stage of the lattice filter reads them.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "base/packed_numbers.h"
#include "smooth/lattice/lattice_simplex.h"
#include "surface/chunk.h"

namespace regionmesh {

/// A vertex, whose position is the centroid of its simplex.
struct LatticeVertex {
    LatticeSimplex simplex;
    SideSet sides = 0;
};

/// Chunks are numbered from 0 in the order in which they are added. Vertices and faces follow each other closely in
/// the lattice, so that differences to the one before take a byte or two: 2 to 3 bytes a vertex, 4 to 7 a face, in
/// place of 32 and 20.
class PackedChunks {
public:
    /// The parts of a chunk; its numbers are local to it, as in Chunk.
    struct Parts {
        std::uint32_t carried = 0;
        std::vector<LatticeVertex> vertices;
        std::vector<ChunkFace> faces;
        std::vector<std::uint32_t> active;
    };

    /// `vertices` are those of the chunk.
    void push_back(const Chunk& chunk, std::span<const LatticeVertex> vertices);
    std::uint32_t end() const { return first_ + static_cast<std::uint32_t>(chunks_.size()); }

    void unpack(std::uint32_t chunk, Parts& parts) const;
    void unpack_vertices(std::uint32_t chunk, std::vector<LatticeVertex>& vertices) const;

    /// Releases the chunks before this one.
    void drop_before(std::uint32_t chunk);
    std::size_t bytes() const { return bytes_; }

private:
    struct Packed {
        std::uint32_t carried, vertices, faces, active;
        std::uint32_t first_face;  // byte at which faces begin; active vertices follow them
        PackedBytes bytes;
    };

    const Packed& of(std::uint32_t chunk) const { return chunks_[chunk - first_]; }

    std::deque<Packed> chunks_;
    std::uint32_t first_ = 0;  // number of chunks_[0]
    std::size_t bytes_ = 0;
};

}  // namespace regionmesh
