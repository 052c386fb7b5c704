#include "regionmesh/smooth.h"

#include "smooth/smoother.h"

namespace regionmesh {

SmoothReport smooth(Mesh& mesh, const SmoothOptions& options) {
    if (options.passes == 0) return {};
    Smoother smoother(options, {});
    smoother.smooth_all(mesh);
    return smoother.report();
}

}  // namespace regionmesh
