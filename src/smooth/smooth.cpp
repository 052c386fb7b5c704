#include "regionmesh/smooth.h"

#include "regionmesh/error.h"
#include "smooth/chunk_smoother.h"
#include "smooth/smoother.h"

namespace regionmesh {

void require_no_lattice(const SmoothOptions& options) {
    if (options.passes > 0 && options.filter == SmoothFilter::kLattice)
        throw Error(ErrorCode::kUsage,
                    "--smooth-filter lattice: only sections have a lattice to keep vertices in; use taubin");
}

SmoothReport smooth(Mesh& mesh, const SmoothOptions& options) {
    if (options.passes == 0) return {};
    require_no_lattice(options);
    SmoothOptions own = options;
    if (own.filter == SmoothFilter::kAuto) own.filter = SmoothFilter::kTaubin;
    Smoother smoother(own, {});
    smoother.smooth_all(mesh);
    return smoother.report();
}

void fix_rims(Mesh& mesh) {
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v}) && mesh[VertexId{v}].sides != 0) mesh[VertexId{v}].is_fixed = true;
}

}  // namespace regionmesh
