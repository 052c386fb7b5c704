// Visits what is there of a mesh, in order of ids.
#pragma once

#include <cstdint>

#include "regionmesh/mesh.h"

namespace regionmesh {

/// Calls visit(VertexId) for each vertex that is alive.
template <class Visit>
void for_vertices(const Mesh& mesh, Visit&& visit) {
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) visit(VertexId{v});
}

/// Calls visit(FaceId) for each face that is alive.
template <class Visit>
void for_faces(const Mesh& mesh, Visit&& visit) {
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        if (mesh.is_alive(FaceId{f})) visit(FaceId{f});
}

}  // namespace regionmesh
