// How far numbers of single precision move the points of a mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "regionmesh/mesh.h"

namespace regionmesh {

/// The rounding of the meshes added, which may be the parts of one.
class EdgeRounding {
public:
    void add(const Mesh& mesh) {
        for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
            if (!mesh.is_alive(FaceId{f})) continue;
            const auto& vertices = mesh[FaceId{f}].vertices;
            for (int n = 0; n < 3; ++n, ++count_) {
                const Vec3 p = mesh.position(vertices[n]);
                farthest_ = std::max({farthest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
                edges_ += length(mesh.position(vertices[(n + 1) % 3]) - p);
            }
        }
    }

    /// The largest error of a coordinate, as a share of the mean edge; 0 without faces.
    double share() const {
        constexpr double kRounding = std::numeric_limits<float>::epsilon() / 2;
        return edges_ > 0 ? kRounding * farthest_ * static_cast<double>(count_) / edges_ : 0;
    }

private:
    double farthest_ = 0, edges_ = 0;
    std::uint64_t count_ = 0;
};

}  // namespace regionmesh
