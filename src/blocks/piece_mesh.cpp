#include "blocks/piece_mesh.h"

#include "stream/place_in_space.h"

namespace regionmesh {

Mesh mesh_of(const Piece& piece, const Manifest& manifest) {
    Mesh mesh;
    mesh.reserve(piece.vertices.size(), piece.faces.size());
    for (const PieceVertex& vertex : piece.vertices) mesh.add_vertex(vertex.position, vertex.sides);
    for (const PieceFace& face : piece.faces)
        mesh.add_face(VertexId{face.vertices[0]}, VertexId{face.vertices[1]}, VertexId{face.vertices[2]},
                      face.labels[0], face.labels[1]);
    unscale_z(mesh, manifest.scale_z);
    place_in_space(mesh, manifest.lattice);
    return mesh;
}

}  // namespace regionmesh
