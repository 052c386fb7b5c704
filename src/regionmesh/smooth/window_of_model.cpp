#include "regionmesh/smooth/window_of_model.h"

namespace regionmesh {
namespace {

/// On all sides of the box at once: no coordinate may change.
constexpr SideSet kAllSides = 0b111111;

}  // namespace

std::vector<std::uint32_t> add_model(const Model& model, SurfaceWindow& window) {
    std::vector<std::uint32_t> number(model.vertex_end());
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) {
        if (!model.is_alive(VertexId{v})) continue;
        number[v] = window.origin.end();
        window.origin.push_back(model.position(VertexId{v}));
        window.sides.push_back(model[VertexId{v}].is_fixed ? kAllSides : model[VertexId{v}].sides);
    }
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const auto& [v, next, labels] = model[FaceId{f}];
        window.faces.push_back({{number[index(v[0])], number[index(v[1])], number[index(v[2])]}, labels});
    }
    return number;
}

}  // namespace regionmesh
