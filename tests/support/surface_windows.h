// A surface as smoothing sees it, and the same surface with other numbers.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/hash.h"
#include "regionmesh/mesh.h"
#include "smooth/filters/neighbours.h"
#include "smooth/surface_window.h"

namespace regionmesh::test {

/// One chunk; numbers are the ids of the mesh. Requires a mesh without free places.
inline SurfaceWindow window_of(const Mesh& mesh) {
    SurfaceWindow window;
    window.add(mesh);
    return window;
}

/// A window of one chunk, and the neighbours in it.
struct Surface {
    explicit Surface(const Mesh& mesh, bool move_points = false) : window(window_of(mesh)), neighbours(move_points) {
        neighbours.add_chunk(window, ChunkStars(window, 0), 1);
    }
    SurfaceWindow window;
    Neighbours neighbours;
};

inline std::vector<std::uint32_t> permutation(std::uint32_t count, std::uint64_t seed) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::uint32_t n) { return mix64(seed * 0x10001 + n); });
    return order;
}

/// The same surface: vertices, faces and their first corners in another order. `order[n]` is the old id of vertex n.
inline Mesh renumbered(const Mesh& mesh, const std::vector<std::uint32_t>& order, std::uint64_t seed) {
    Mesh result;
    std::vector<VertexId> now(mesh.vertex_end());
    for (std::uint32_t v : order) now[v] = result.add_vertex(mesh.position(VertexId{v}), mesh[VertexId{v}].sides);
    for (std::uint32_t f : permutation(mesh.face_end(), seed + 1)) {
        const Face& face = mesh[FaceId{f}];
        const auto at = [&](std::uint32_t n) { return now[index(face.vertices[(f + seed + n) % 3])]; };
        result.add_face(at(0), at(1), at(2), face.labels[0], face.labels[1]);
    }
    return result;
}
inline Mesh renumbered(const Mesh& mesh, std::uint64_t seed) {
    return renumbered(mesh, permutation(mesh.vertex_end(), seed), seed);
}

/// Ids stay. Requires a model without free places.
inline Mesh copy_of(const Mesh& mesh) {
    Mesh copy;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        copy.add_vertex(mesh.position(VertexId{v}), mesh[VertexId{v}].sides);
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const auto& v = mesh[FaceId{f}].vertices;
        copy.add_face(v[0], v[1], v[2], mesh[FaceId{f}].labels[0], mesh[FaceId{f}].labels[1]);
    }
    return copy;
}

}  // namespace regionmesh::test
