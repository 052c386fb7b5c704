#include "mesh/region_volumes.h"

namespace regionmesh {

std::vector<double> region_volumes(const Mesh& mesh) {
    std::vector<double> volumes;
    std::optional<Vec3> apex;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto [a, b, c] = mesh.corners(FaceId{f});
        add_cone(volumes, apex, mesh[FaceId{f}].labels, a, b, c);
    }
    return volumes;
}

}  // namespace regionmesh
