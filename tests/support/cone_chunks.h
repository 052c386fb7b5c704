// The unsmoothed reconstruction as the lattice filter needs it: quads of tetrahedra are cut into cones.
#pragma once

#include <vector>

#include "cells/strip_mesher.h"
#include "regionmesh/mesh.h"
#include "support/volumes.h"

namespace regionmesh::test {

/// A chunk for each strip. Labels of the volume are dense labels already.
inline std::vector<Chunk> cone_chunks(ArrayVolume volume, CellKind cells = CellKind::kTetrahedra,
                                      Sweep sweep = kSweepZ) {
    volume.swept(sweep);
    StripMesher mesher(volume.info().lattice, sweep, {.cells = cells, .cuts = QuadCuts::kCones});
    std::vector<InputLabel> section(std::size_t{volume.section_width()} * volume.section_height());
    std::vector<Label> low, high;
    std::vector<Chunk> chunks;
    while (volume.next(section)) {
        low.swap(high);
        high.assign(section.begin(), section.end());
        if (!low.empty()) mesher.mesh(low, high, chunks.emplace_back());
    }
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
