#include "smooth/filters/guarded_move.h"

#include <cassert>

#include "smooth/filters/intersection_resolver.h"

namespace regionmesh {

std::vector<std::uint8_t> move_guarded(Mesh& mesh, const std::vector<Vec3>& to, const SmoothOptions& options) {
    SurfaceWindow window;
    const std::vector<std::uint32_t> number = window.add(mesh);
    SlidingArray<Vec3> smooth, now;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        smooth.push_back(to[v]);
        now.push_back(to[v]);
    }
    StepLengths steps;
    steps.backtrack.grow(window.origin.end());
    steps.wanted.grow(window.origin.end());
    steps.smooth = &smooth;
    steps.now = &now;
    BacktrackRounds rounds(window, steps, options);
    for (std::uint32_t round = 0; round < BacktrackRounds::kRounds; ++round) rounds.run(round, 0, true);
    IntersectionResolver resolver(window, steps, options);
    resolver.note_chunk(0);
    resolver.note_whole();
    [[maybe_unused]] const bool is_resolved = resolver.add_chunk(0);
    assert(is_resolved);
    std::vector<std::uint8_t> backtrack(mesh.vertex_end());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        mesh[VertexId{v}].position = now[number[v]];
        backtrack[v] = steps.backtrack[number[v]];
    }
    return backtrack;
}

}  // namespace regionmesh
