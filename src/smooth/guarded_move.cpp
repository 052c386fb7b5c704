#include "smooth/guarded_move.h"

#include "smooth/settle.h"
#include "smooth/window_of_mesh.h"

namespace regionmesh {

std::vector<std::uint8_t> move_guarded(Mesh& mesh, const std::vector<Vec3>& to, const SmoothOptions& options) {
    SurfaceWindow window;
    const std::vector<std::uint32_t> number = add_mesh(mesh, window);
    window.end_layer();
    SlidingArray<Vec3> smooth, now;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        smooth.push_back(to[v]);
        now.push_back(to[v]);
    }
    Stand stand;
    stand.level.grow(window.origin.end());
    stand.wanted.grow(window.origin.end());
    stand.smooth = &smooth;
    stand.now = &now;
    StepBackRounds rounds(window, stand, options);
    for (std::uint32_t round = 0; round < StepBackRounds::kRounds; ++round) rounds.run(round, 0, true);
    Settling settling(window, stand, options);
    settling.note_layer(0);
    settling.add_layer(0);
    std::vector<std::uint8_t> levels(mesh.vertex_end());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        mesh[VertexId{v}].position = now[number[v]];
        levels[v] = stand.level[number[v]];
    }
    return levels;
}

}  // namespace regionmesh
