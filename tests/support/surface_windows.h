// A surface as smoothing sees it, and the same surface with other numbers.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "regionmesh/base/hash.h"
#include "regionmesh/model/model.h"
#include "regionmesh/smooth/neighbours.h"
#include "regionmesh/smooth/surface_window.h"

namespace regionmesh::test {

/// One layer; numbers are the ids of the model. Requires a model without free places.
inline SurfaceWindow window_of(const Model& model) {
    SurfaceWindow window;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) {
        window.origin.push_back(model.position(VertexId{v}));
        window.sides.push_back(model[VertexId{v}].sides);
    }
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        const auto& v = model[FaceId{f}].vertices;
        window.faces.push_back({{index(v[0]), index(v[1]), index(v[2])}, model[FaceId{f}].labels});
    }
    window.end_layer();
    return window;
}

/// A window of one layer, and the neighbours in it.
struct Surface {
    explicit Surface(const Model& model, bool move_points = false) : window(window_of(model)), neighbours(move_points) {
        neighbours.add_layer(window, LayerStars(window, 0), 1);
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
inline Model renumbered(const Model& model, const std::vector<std::uint32_t>& order, std::uint64_t seed) {
    Model result;
    std::vector<VertexId> now(model.vertex_end());
    for (std::uint32_t v : order) now[v] = result.add_vertex(model.position(VertexId{v}), model[VertexId{v}].sides);
    for (std::uint32_t f : permutation(model.face_end(), seed + 1)) {
        const Face& face = model[FaceId{f}];
        const auto at = [&](std::uint32_t n) { return now[index(face.vertices[(f + seed + n) % 3])]; };
        result.add_face(at(0), at(1), at(2), face.labels[0], face.labels[1]);
    }
    return result;
}
inline Model renumbered(const Model& model, std::uint64_t seed) { return renumbered(model, permutation(model.vertex_end(), seed), seed); }


/// Ids stay. Requires a model without free places.
inline Model copy_of(const Model& model) {
    Model copy;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) copy.add_vertex(model.position(VertexId{v}), model[VertexId{v}].sides);
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        const auto& v = model[FaceId{f}].vertices;
        copy.add_face(v[0], v[1], v[2], model[FaceId{f}].labels[0], model[FaceId{f}].labels[1]);
    }
    return copy;
}

}  // namespace regionmesh::test
