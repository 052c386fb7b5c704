#include "regionmesh/limits.h"

#include <string>

#include "regionmesh/error.h"

namespace regionmesh {

void require_mesh_size(const char* what, std::uint64_t vertices, std::uint64_t faces) {
    const auto require = [&](std::uint64_t count, std::uint64_t most, const char* things) {
        if (count > most)
            throw Error(ErrorCode::kInput, std::string(what) + ": " + std::to_string(count) + " " + things +
                                               ", more than " + std::to_string(most) + "; use a part of it");
    };
    require(vertices, kMostVertices, "vertices");
    require(faces, kMostFaces, "faces");
}

}  // namespace regionmesh
