#include "smooth/chunk_smoother.h"

#include <algorithm>
#include <cmath>

#include "mesh/region_volumes.h"
#include "smooth/lattice_smoother.h"
#include "smooth/smoother.h"

namespace regionmesh {

std::unique_ptr<ChunkSmoother> make_chunk_smoother(const SmoothOptions& options, const ChunkOrder& order) {
    if (options.filter == SmoothFilter::kLattice) return std::make_unique<LatticeSmoother>(options, order);
    return std::make_unique<Smoother>(options, order);
}

void note_chunk(const SurfaceWindow& window, std::uint32_t chunk, const SlidingArray<Vec3>& positions,
                SmoothReport& report) {
    double sum = report.rms_displacement * report.rms_displacement * static_cast<double>(report.vertices);
    double farthest2 = 0;
    const NumberRange vertices = window.vertices_of(chunk), faces = window.faces_of(chunk);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
        const double moved = length2(positions[v] - window.origin[v]);
        sum += moved;
        farthest2 = std::max(farthest2, moved);
    }
    report.largest_displacement = std::max(report.largest_displacement, std::sqrt(farthest2));
    report.vertices += vertices.size();
    if (report.vertices > 0) report.rms_displacement = std::sqrt(sum / static_cast<double>(report.vertices));
    for (std::uint32_t f = faces.first; f < faces.end; ++f) {
        const auto& [v, labels] = window.faces[f];
        add_cone(report.volume_before, labels, window.origin[v[0]], window.origin[v[1]], window.origin[v[2]]);
        add_cone(report.volume_after, labels, positions[v[0]], positions[v[1]], positions[v[2]]);
    }
}

}  // namespace regionmesh
