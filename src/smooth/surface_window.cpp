#include "smooth/surface_window.h"

#include <cassert>

#include "regionmesh/error.h"

namespace regionmesh {

SurfaceWindow::SurfaceWindow() { starts_.push_back({0, 0}); }

void SurfaceWindow::end_chunk(std::span<const std::uint32_t> active) {
    starts_.push_back({origin.end(), faces.end()});
    active_.push_back(active);
}

std::span<const std::uint32_t> SurfaceWindow::carried_by(std::uint32_t chunk) const {
    return chunk == 0 ? std::span<const std::uint32_t>() : active_.of(chunk - 1);
}

void SurfaceWindow::add(const Chunk& chunk) {
    const std::span<const std::uint32_t> carried = carried_by(chunk_end());
    assert(chunk.carried == carried.size());
    const std::uint32_t first = origin.end(), most = ~std::uint32_t{0};
    if (chunk.vertices.size() > most - first || chunk.faces.size() > most - faces.end())
        throw Error(ErrorCode::kInput,
                    "smoothing: more than 2^32 faces before decimation; with --smooth-filter lattice "
                    "the model can be made in blocks (--block-size)");
    const auto number = [&](std::uint32_t local) {
        return local < chunk.carried ? carried[local] : first + (local - chunk.carried);
    };
    for (const ChunkVertex& vertex : chunk.vertices) {
        origin.push_back(vertex.position);
        sides.push_back(vertex.sides);
    }
    for (const auto& [v, labels] : chunk.faces) faces.push_back({{number(v[0]), number(v[1]), number(v[2])}, labels});
    std::vector<std::uint32_t> active;
    for (std::uint32_t local : chunk.active) active.push_back(number(local));
    end_chunk(active);
}

std::vector<std::uint32_t> SurfaceWindow::add(const Mesh& mesh) {
    std::vector<std::uint32_t> number(mesh.vertex_end());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        number[v] = origin.end();
        origin.push_back(mesh.position(VertexId{v}));
        sides.push_back(mesh[VertexId{v}].is_fixed ? kBoxSides  // no coordinate may change
                                                   : mesh[VertexId{v}].sides);
    }
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto& [v, next, labels] = mesh[FaceId{f}];
        faces.push_back({{number[index(v[0])], number[index(v[1])], number[index(v[2])]}, labels});
    }
    end_chunk({});
    return number;
}

void SurfaceWindow::copy_out(std::uint32_t chunk, const SlidingArray<Vec3>& positions, Chunk& out) const {
    const NumberRange own = vertices_of(chunk), own_faces = faces_of(chunk);
    const std::span<const std::uint32_t> carried = carried_by(chunk);
    out.clear();
    out.carried = static_cast<std::uint32_t>(carried.size());
    // Carried vertices belong to the chunk before.
    const std::uint32_t before = chunk == 0 ? own.first : vertices_of(chunk - 1).first;
    std::vector<std::uint32_t> local_of_carried(own.first - before);
    for (std::uint32_t n = 0; n < out.carried; ++n) local_of_carried[carried[n] - before] = n;
    const auto local = [&](std::uint32_t v) {
        return v < own.first ? local_of_carried[v - before] : out.carried + (v - own.first);
    };
    for (std::uint32_t v = own.first; v < own.end; ++v) out.vertices.push_back({positions[v], sides[v]});
    for (std::uint32_t f = own_faces.first; f < own_faces.end; ++f) {
        const auto& [v, labels] = faces[f];
        out.faces.push_back({{local(v[0]), local(v[1]), local(v[2])}, labels});
    }
    for (std::uint32_t v : active_.of(chunk)) out.active.push_back(local(v));
}

void SurfaceWindow::drop_before(std::uint32_t chunk) {
    if (chunk == 0) return;
    starts_.drop_before(chunk - 1);
    active_.drop_before(chunk - 1);
    origin.drop_before(starts_[chunk - 1].vertex);
    sides.drop_before(starts_[chunk - 1].vertex);
    faces.drop_before(starts_[chunk].face);
}

}  // namespace regionmesh
