#include "regionmesh/model/region_volumes.h"

namespace regionmesh {

std::vector<double> region_volumes(const Model& model) {
    std::vector<double> volumes;
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const auto [a, b, c] = model.corners(FaceId{f});
        add_cone(volumes, model[FaceId{f}].labels, a, b, c);
    }
    return volumes;
}

}  // namespace regionmesh
