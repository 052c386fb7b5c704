// A part of a surface in a mesh that also has the faces round it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "regionmesh/ids.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Which part each vertex and each face belongs to. Each belongs to one. The mesh has all faces whose boxes reach into
/// the place of the part.
struct MeshPart {
    std::uint32_t number = 0;
    std::vector<std::uint32_t> of_vertex, of_face;
    std::vector<Vec3> low_of_face;                    // the low corner of its box
    std::function<std::uint32_t(Vec3)> at = nullptr;  // the part whose place has a point

    bool has(VertexId v) const { return of_vertex[index(v)] == number; }
    bool has(FaceId f) const { return of_face[index(f)] == number; }
    /// A pair of faces belongs to the part at the low corner of what their boxes have in common: it has both.
    bool has(FaceId f, FaceId g) const { return at(max(low_of_face[index(f)], low_of_face[index(g)])) == number; }
    std::string text() const { return " in part " + std::to_string(number); }
};

}  // namespace regionmesh
