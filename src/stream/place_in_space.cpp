#include "stream/place_in_space.h"

#include "mesh/alive.h"

namespace regionmesh {

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
    const double determinant =
        d[0] * (d[4] * d[8] - d[5] * d[7]) - d[1] * (d[3] * d[8] - d[5] * d[6]) + d[2] * (d[3] * d[7] - d[4] * d[6]);
    if (determinant < 0) mesh.flip_faces();
}

}  // namespace regionmesh
