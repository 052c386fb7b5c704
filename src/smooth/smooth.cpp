#include "regionmesh/smooth.h"

#include "smooth/smoother.h"
#include "smooth/window_of_mesh.h"

namespace regionmesh {

SmoothReport smooth(Mesh& mesh, const SmoothOptions& options) {
    if (options.passes == 0) return {};
    Smoother smoother(options, {});
    const std::vector<std::uint32_t> number = add_mesh(mesh, smoother.window());
    smoother.end_layer(true);
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v})) mesh[VertexId{v}].position = smoother.place(number[v]);
    return smoother.report();
}

}  // namespace regionmesh
