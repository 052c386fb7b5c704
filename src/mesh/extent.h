// The bounding boxes of a mesh and of its faces.
#pragma once

#include <cstdint>

#include "base/box.h"
#include "base/parallel_for.h"
#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The bounding box of a face; empty if the face was removed.
inline Box box_of(const Mesh& mesh, FaceId f) { return mesh.is_alive(f) ? box_of(mesh.corners(f)) : Box(); }

/// The bounding box of all vertices.
inline Box extent_of(const Mesh& mesh, std::uint32_t threads) {
    Box extent;
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        Box box;
        for (std::uint32_t v = first; v < end; ++v)
            if (mesh.is_alive(VertexId{v})) box.add(mesh.position(VertexId{v}));
        return box;
    };
    for_chunks(mesh.vertex_end(), 1 << 16, threads, find, [&](const Box& box) { extent.join(box); });
    return extent;
}

}  // namespace regionmesh
