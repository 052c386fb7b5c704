#include "smooth/chunk_smoother.h"

#include <algorithm>
#include <cmath>

#include "mesh/region_volumes.h"
#include "smooth/lattice/lattice_smoother.h"
#include "smooth/smoother.h"

namespace regionmesh {
namespace {

template <class Positions>
void note_vertices(NumberRange vertices, const Positions& before, const Positions& after, SmoothReport& report) {
    double sum = report.rms_displacement * report.rms_displacement * static_cast<double>(report.vertices);
    double farthest2 = 0;
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
        const double moved = length2(after[v] - before[v]);
        sum += moved;
        farthest2 = std::max(farthest2, moved);
    }
    report.largest_displacement = std::max(report.largest_displacement, std::sqrt(farthest2));
    report.vertices += vertices.size();
    if (report.vertices > 0) report.rms_displacement = std::sqrt(sum / static_cast<double>(report.vertices));
}

template <class Positions>
void note_face(const ChunkFace& face, const Positions& before, const Positions& after, SmoothReport& report) {
    const auto& [v, labels] = face;
    add_cone(report.volume_before, report.apex, labels, before[v[0]], before[v[1]], before[v[2]]);
    add_cone(report.volume_after, report.apex, labels, after[v[0]], after[v[1]], after[v[2]]);
}

}  // namespace

std::unique_ptr<ChunkSmoother> make_chunk_smoother(const SmoothOptions& options, const ChunkOrder& order) {
    if (options.filter == SmoothFilter::kLattice) return std::make_unique<LatticeSmoother>(options, order);
    return std::make_unique<Smoother>(options, order);
}

void note_chunk(const MovedChunk& chunk, SmoothReport& report) {
    const auto end = static_cast<std::uint32_t>(chunk.after.size());
    note_vertices({chunk.carried, end}, chunk.before, chunk.after, report);
    for (const ChunkFace& face : chunk.faces) note_face(face, chunk.before, chunk.after, report);
}

void note_chunk(const SurfaceWindow& window, std::uint32_t chunk, const SlidingArray<Vec3>& positions,
                SmoothReport& report) {
    note_vertices(window.vertices_of(chunk), window.origin, positions, report);
    const NumberRange faces = window.faces_of(chunk);
    for (std::uint32_t f = faces.first; f < faces.end; ++f)
        note_face(window.faces[f], window.origin, positions, report);
}

}  // namespace regionmesh
