#include "blocks/precomputed/levels.h"

namespace regionmesh {
namespace {

constexpr std::uint64_t kFewestFaces = 20000;
constexpr std::uint32_t kMostLevels = 8;

}  // namespace

std::uint32_t level_count(std::uint64_t faces) {
    std::uint32_t levels = 1;
    for (; levels < kMostLevels && faces / kFacesPerLevel >= kFewestFaces; ++levels) faces /= kFacesPerLevel;
    return levels;
}

SimplifyOptions next_level_options(const Mesh& mesh, std::uint32_t threads) {
    return {.target_faces = mesh.face_count() / kFacesPerLevel,
            .promises = {.scale = typical_edge(mesh)},
            .threads = threads};
}

}  // namespace regionmesh
