#include "regionmesh/smooth.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "base/option_range.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/error.h"
#include "smooth/chunk_smoother.h"
#include "smooth/smoother.h"

namespace regionmesh {

void require_in_range(const SmoothOptions& options) {
    constexpr OptionRange kReach{1e-6, 1e6, "0.000001 to 1000000"};
    constexpr double kBlocks[] = {0, 2, 4, 8, 16};
    if (std::ranges::find(kBlocks, options.reach) == std::end(kBlocks))
        throw Error(ErrorCode::kUsage, "smooth.reach: " + std::to_string(options.reach) +
                                           " is none of 0, 2, 4, 8 and 16; give one of them");
    require_choice("smooth.filter", options.filter, SmoothFilter::kNifpms);
    require_number("smooth.passes", options.passes, {0, kMostSmoothPasses, "0 to 100000"});
    require_number("smooth.lambda", options.lambda, {0, 1, "0 to 1"});
    require_number("smooth.mu_per_lambda", options.mu_per_lambda, kNotNegative);
    require_number("smooth.scale", options.scale, kPositive);
    require_number("smooth.nifpms_reach", options.nifpms_reach, kReach);
    require_number("smooth.nifpms_bound", options.nifpms_bound, kReach);
    require_number("smooth.min_quality", options.min_quality, kQualityRange);
}

void require_no_lattice(const SmoothOptions& options) {
    if (options.passes > 0 && options.filter == SmoothFilter::kLattice)
        throw Error(ErrorCode::kUsage,
                    "--smooth-filter lattice: only sections have a lattice to keep vertices in; use taubin");
}

void SmoothReport::scale_volumes(double factor) {
    for (std::vector<double>* volumes : {&volume_before, &volume_after})
        for (double& volume : *volumes) volume *= factor;
}

SmoothReport smooth(Mesh& mesh, const SmoothOptions& options) {
    if (options.passes == 0) return {};
    require_in_range(options);
    require_no_lattice(options);
    require_along_axes(mesh);
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
