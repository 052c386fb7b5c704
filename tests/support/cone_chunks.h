// The unsmoothed reconstruction as the lattice filter needs it: quads of tetrahedra are cut into cones.
#pragma once

#include <vector>

#include "cells/strip_mesher.h"
#include "regionmesh/mesh.h"
#include "support/volumes.h"

namespace regionmesh::test {

/// A chunk for each strip. Labels of the volume are dense labels already.
inline std::vector<Chunk> cone_chunks(const ArrayVolume& volume, CellKind cells = CellKind::kTetrahedra) {
    const Size size = volume.size();
    const std::size_t area = std::size_t{size[0]} * size[1];
    const std::vector<Label> labels(volume.labels().begin(), volume.labels().end());
    StripMesher mesher(volume.info().lattice, kSweepZ, {.cells = cells, .cuts = QuadCuts::kCones});
    std::vector<Chunk> chunks(size[2] - 1);
    for (std::uint32_t strip = 0; strip + 1 < size[2]; ++strip)
        mesher.mesh(std::span(labels).subspan(strip * area, area), std::span(labels).subspan((strip + 1) * area, area),
                    chunks[strip]);
    return chunks;
}

inline Mesh mesh_of(const std::vector<Chunk>& chunks) {
    Mesh mesh;
    std::vector<VertexId> number, active;
    for (const Chunk& chunk : chunks) {
        number = active;
        for (const ChunkVertex& vertex : chunk.vertices)
            number.push_back(mesh.add_vertex(vertex.position, vertex.sides));
        for (const ChunkFace& face : chunk.faces)
            mesh.add_face(number[face.vertices[0]], number[face.vertices[1]], number[face.vertices[2]], face.labels[0],
                          face.labels[1]);
        active.clear();
        for (std::uint32_t local : chunk.active) active.push_back(number[local]);
    }
    return mesh;
}

}  // namespace regionmesh::test
