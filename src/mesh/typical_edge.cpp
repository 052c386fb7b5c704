#include <cmath>

#include "base/triangle.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

double typical_edge(const Mesh& mesh) {
    double area = 0;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto [a, b, c] = mesh.corners(FaceId{f});
        area += 0.5 * length(area_vector(a, b, c));
    }
    return area > 0 ? std::sqrt(4 / std::sqrt(3.0) * area / mesh.face_count()) : 1;
}

}  // namespace regionmesh
