#include "smooth/filters/relax.h"

#include "base/parallel_for.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

using smoothing::kRelaxTask;

}  // namespace

double Relaxation::farthest() const {
    const bool is_taubin = input_.options.filter == SmoothFilter::kTaubin;
    return 1 +
           input_.options.passes / (is_taubin ? smoothing::kTaubinPassesPerUnit : smoothing::kLaplacianPassesPerUnit);
}

double relax_factor(const SmoothOptions& options, std::uint32_t pass) {
    const bool is_back = options.filter == SmoothFilter::kTaubin && pass % 2 == 1;
    return is_back ? -options.mu_per_lambda * options.lambda : options.lambda;
}

void relax(const SurfaceWindow& window, const Neighbours& neighbours, NumberRange vertices, double factor,
           const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to, std::uint32_t threads) {
    parallel_for((vertices.size() + kRelaxTask - 1) / kRelaxTask, threads, [&](std::uint32_t n) {
        const std::uint32_t first = vertices.first + n * kRelaxTask, end = std::min(vertices.end, first + kRelaxTask);
        for (std::uint32_t v = first; v < end; ++v) {
            const auto list = neighbours.of(v);
            Vec3 p = from[v];
            if (!list.empty()) {
                Vec3 sum;
                for (std::uint32_t w : list) sum += from[w];
                const Vec3 before = p;
                p += factor * (sum / static_cast<double>(list.size()) - p);
                if (const SideSet sides = window.sides[v]) keep_on_sides(sides, before, p);
            }
            to[v] = p;
        }
    });
}

}  // namespace regionmesh
