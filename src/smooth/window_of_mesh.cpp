#include "smooth/window_of_mesh.h"

namespace regionmesh {
namespace {

/// On all sides of the box at once: no coordinate may change.
constexpr SideSet kAllSides = 0b111111;

}  // namespace

std::vector<std::uint32_t> add_mesh(const Mesh& mesh, SurfaceWindow& window) {
    std::vector<std::uint32_t> number(mesh.vertex_end());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        number[v] = window.origin.end();
        window.origin.push_back(mesh.position(VertexId{v}));
        window.sides.push_back(mesh[VertexId{v}].is_fixed ? kAllSides : mesh[VertexId{v}].sides);
    }
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto& [v, next, labels] = mesh[FaceId{f}];
        window.faces.push_back({{number[index(v[0])], number[index(v[1])], number[index(v[2])]}, labels});
    }
    return number;
}

}  // namespace regionmesh
