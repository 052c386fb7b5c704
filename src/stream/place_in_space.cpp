#include "stream/place_in_space.h"

#include "mesh/alive.h"
#include "mesh/box_sides.h"

namespace regionmesh {
namespace {

/// What the sides of the lattice are in space, where the axes take the numbers of the coordinates near them.
std::array<int, 6> sides_in_space(const Lattice& lattice) {
    const auto [axes, are_reversed] = axes_by_coordinate(lattice.axes());
    std::array<int, 6> names{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t high = 0; high < 2; ++high)
            names[2 * axes[axis] + high] = static_cast<int>(2 * axis + (are_reversed[axis] ? 1 - high : high));
    return names;
}

}  // namespace

void unscale_z(Mesh& mesh, double scale_z) {
    if (scale_z == 1) return;
    for_vertices(mesh, [&](VertexId v) { mesh[v].position.z /= scale_z; });
}

void place_in_space(Mesh& mesh, const Lattice& lattice) {
    if (lattice.is_axis_aligned()) return;
    const auto& d = lattice.direction;
    for_vertices(mesh, [&](VertexId v) {
        Vec3& p = mesh[v].position;
        p = lattice.origin + Vec3{d[0] * p.x + d[1] * p.y + d[2] * p.z, d[3] * p.x + d[4] * p.y + d[5] * p.z,
                                  d[6] * p.x + d[7] * p.y + d[8] * p.z};
    });
    if (lattice.axes_volume() < 0) mesh.flip_faces();
    mesh.rename_sides(sides_in_space(lattice));
}

}  // namespace regionmesh
