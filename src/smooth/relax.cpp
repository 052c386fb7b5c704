#include "smooth/relax.h"

#include "base/parallel_for.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 4096;  // vertices

}  // namespace

double relax_factor(const SmoothOptions& options, std::uint32_t pass) {
    const bool is_back = options.filter == SmoothFilter::kTaubin && pass % 2 == 1;
    return is_back ? -options.mu_per_lambda * options.lambda : options.lambda;
}

void relax(const SurfaceWindow& window, const Neighbours& neighbours, NumberRange vertices, double factor,
           const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to, std::uint32_t threads) {
    parallel_for((vertices.size() + kChunk - 1) / kChunk, threads, [&](std::uint32_t n) {
        const std::uint32_t first = vertices.first + n * kChunk, end = std::min(vertices.end, first + kChunk);
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
