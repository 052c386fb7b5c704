// The chunks of a multi-resolution mesh, and faces cut along their walls.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Steps along each edge of a chunk: positions in it are 16-bit integers, 0 on one wall and this on the other.
inline constexpr std::int64_t kChunkSteps = 65535;

/// A place in steps from the origin of the grid, at a level of detail.
using StepPoint = std::array<std::int64_t, 3>;
using StepFace = std::array<StepPoint, 3>;

/// A part of a face in one chunk; corners in steps from the corner of the chunk.
struct ChunkFacePart {
    std::array<std::uint32_t, 3> chunk;
    std::array<std::array<std::uint16_t, 3>, 3> corners;
};

/// Cubes of one size at level 0, twice as large at each further level. All levels have the same origin. Steps, walls
/// and cuts are the same for all faces, so faces that share corners before share them after: cracks do not arise.
class ChunkGrid {
public:
    /// Over `box`, in nanometres; `chunk` is the edge of a chunk at level 0. Both are rounded to single precision,
    /// which files have; the origin is not above the box.
    ChunkGrid(const Box& box, double chunk);

    Vec3 origin() const { return origin_; }
    double chunk() const { return chunk_; }
    /// The length of a step.
    double step(std::uint32_t level) const;

    /// The nearest place. Requires a position in the box.
    StepPoint nearest(Vec3 position, std::uint32_t level) const;

    /// Cuts a face along the walls of the chunks, and above level 0 also along the planes that halve them, and calls
    /// visit with each part that has three different corners. A new corner is the nearest place to where an edge meets
    /// a plane, and depends on the edge alone. A part in a wall belongs to the chunk below it.
    void cut(const StepFace& face, std::uint32_t level, const std::function<void(const ChunkFacePart&)>& visit) const;

private:
    Vec3 origin_;
    double chunk_;
};

}  // namespace regionmesh
