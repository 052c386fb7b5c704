#include "regionmesh/smooth/smooth.h"

#include "regionmesh/smooth/smoother.h"
#include "regionmesh/smooth/window_of_model.h"

namespace regionmesh {

SmoothReport smooth(Model& model, const SmoothOptions& options) {
    if (options.passes == 0) return {};
    Smoother smoother(options, {});
    const std::vector<std::uint32_t> number = add_model(model, smoother.window());
    smoother.end_layer(true);
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v)
        if (model.is_alive(VertexId{v})) model[VertexId{v}].position = smoother.place(number[v]);
    return smoother.report();
}

}  // namespace regionmesh
