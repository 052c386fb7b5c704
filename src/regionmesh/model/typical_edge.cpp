#include "regionmesh/model/typical_edge.h"

#include <cmath>

#include "regionmesh/base/triangle.h"

namespace regionmesh {

double typical_edge(const Model& model) {
    double area = 0;
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const auto [a, b, c] = model.corners(FaceId{f});
        area += 0.5 * length(area_vector(a, b, c));
    }
    return area > 0 ? std::sqrt(4 / std::sqrt(3.0) * area / model.face_count()) : 1;
}

}  // namespace regionmesh
