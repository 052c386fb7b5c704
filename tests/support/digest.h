// A model as one number, to compare runs.
#pragma once

#include <bit>
#include <cstdint>

#include "base/hash.h"
#include "regionmesh/mesh.h"

namespace regionmesh::test {

inline std::uint64_t digest(std::uint64_t sum, Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) sum = mix64(sum ^ std::bit_cast<std::uint64_t>(p[axis]));
    return sum;
}

/// Changes with every bit of every position, every face and every label, and with their order.
inline std::uint64_t digest(const Mesh& mesh) {
    std::uint64_t sum = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v}))
            sum = digest(mix64(sum ^ v), mesh.position(VertexId{v})) + mesh[VertexId{v}].sides;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        for (VertexId v : mesh[FaceId{f}].vertices) sum = mix64(sum ^ index(v));
        for (Label label : mesh[FaceId{f}].labels) sum = mix64(sum ^ label);
    }
    return sum;
}

/// The same for any order of vertices and faces, and for any first corner of a face.
inline std::uint64_t surface_digest(const Mesh& mesh) {
    std::uint64_t sum = 0;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto p = mesh.corners(FaceId{f});
        std::uint64_t turned = 0;
        for (int n = 0; n < 3; ++n) turned += digest(digest(digest(1, p[n]), p[(n + 1) % 3]), p[(n + 2) % 3]);
        for (Label label : mesh[FaceId{f}].labels) turned = mix64(turned ^ label);
        sum += turned;
    }
    return sum;
}

}  // namespace regionmesh::test
