// A part of a surface in a mesh that also has the faces round it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "regionmesh/ids.h"

namespace regionmesh {

/// Which part each vertex and each face belongs to. Each belongs to one.
struct MeshPart {
    std::uint32_t number = 0;
    std::vector<std::uint32_t> of_vertex, of_face;

    bool has(VertexId v) const { return of_vertex[index(v)] == number; }
    bool has(FaceId f) const { return of_face[index(f)] == number; }
    /// A pair of faces belongs to the first of their parts.
    bool has(FaceId f, FaceId g) const { return std::min(of_face[index(f)], of_face[index(g)]) == number; }
    std::string text() const { return " in part " + std::to_string(number); }
};

}  // namespace regionmesh
