#include "surface/chunk.h"

#include <algorithm>

namespace regionmesh {

void Chunk::append(const Chunk& next) {
    if (vertices.empty() && faces.empty()) {
        *this = next;
        return;
    }
    const std::uint32_t first_new = carried + static_cast<std::uint32_t>(vertices.size());
    const std::vector<std::uint32_t> joint = std::move(active);
    const auto here = [&](std::uint32_t local) {
        return local < next.carried ? joint[local] : first_new + local - next.carried;
    };
    for (std::size_t n = 0; n < next.carried_bounds.size(); ++n) raise_bound(joint[n], next.carried_bounds[n]);
    vertices.insert(vertices.end(), next.vertices.begin(), next.vertices.end());
    simplices.insert(simplices.end(), next.simplices.begin(), next.simplices.end());
    for (const ChunkFace& face : next.faces)
        faces.push_back({{here(face.vertices[0]), here(face.vertices[1]), here(face.vertices[2])}, face.labels});
    active.clear();
    for (std::uint32_t local : next.active) active.push_back(here(local));
}

void Chunk::raise_bound(std::uint32_t local, float bound) {
    if (local < carried) carried_bounds.resize(carried);
    float& raised = local < carried ? carried_bounds[local] : vertices[local - carried].error_bound;
    raised = std::max(raised, bound);
}

std::vector<ChunkVertex> active_vertices(const Chunk& chunk, std::span<const ChunkVertex> carried) {
    std::vector<ChunkVertex> vertices;
    for (const std::uint32_t local : chunk.active) vertices.push_back(vertex_of(chunk, carried, local));
    return vertices;
}

}  // namespace regionmesh
