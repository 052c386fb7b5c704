#include "regionmesh/smooth/smooth.h"

#include <vector>

#include "regionmesh/smooth/smoother.h"

namespace regionmesh {

SmoothReport smooth(Model& model, const SmoothOptions& options) {
    if (options.passes == 0) return {};
    Smoother smoother(options, {});
    SurfaceWindow& window = smoother.window();
    std::vector<std::uint32_t> number(model.vertex_end());
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) {
        if (!model.is_alive(VertexId{v})) continue;
        number[v] = window.origin.end();
        window.origin.push_back(model.position(VertexId{v}));
        window.sides.push_back(model[VertexId{v}].sides);
    }
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const Face& face = model[FaceId{f}];
        window.faces.push_back(
            {{number[index(face.vertices[0])], number[index(face.vertices[1])], number[index(face.vertices[2])]},
             face.labels});
    }
    smoother.end_layer(true);
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v)
        if (model.is_alive(VertexId{v})) model[VertexId{v}].position = smoother.place(number[v]);
    return smoother.report();
}

}  // namespace regionmesh
