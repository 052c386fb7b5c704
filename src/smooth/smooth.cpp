#include "regionmesh/smooth.h"

#include "regionmesh/error.h"
#include "smooth/chunk_smoother.h"
#include "smooth/smoother.h"

namespace regionmesh {

void require_no_lattice(const SmoothOptions& options) {
    if (options.passes > 0 && options.filter == SmoothFilter::kLattice)
        throw Error(ErrorCode::kInput,
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

}  // namespace regionmesh
