#include "blocks/folder_parts.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "blocks/gather.h"
#include "mesh/extent.h"
#include "stream/place_in_space.h"

namespace regionmesh {

Box BlockFolder::placed(const Box& box) const {
    if (box.is_empty()) return box;
    Mesh corners;
    for (int n = 0; n < 8; ++n)
        corners.add_vertex(
            {(n & 1 ? box.low : box.high).x, (n & 2 ? box.low : box.high).y, (n & 4 ? box.low : box.high).z});
    place(corners);
    Box around = extent_of(corners, 1);
    const double rounding = 1e-12 * (length(around.low) + length(around.high));
    around.low = around.low - Vec3{rounding, rounding, rounding};
    around.high = around.high + Vec3{rounding, rounding, rounding};
    return around;
}

void BlockFolder::place(Mesh& mesh) const {
    unscale_z(mesh, manifest.scale_z);
    place_in_space(mesh, manifest.lattice);
}

Mesh read_part(const BlockFolder& folder, std::uint32_t block, MeshPart& part) {
    part = {
        .number = block, .of_vertex = {}, .of_face = {}, .low_of_face = {}, .key_of_face = {}, .at = [&](Vec3 place) {
            return folder.grid.block_at(place);
        }};
    BlockGatherer gatherer(folder.grid, block);
    std::vector<std::uint32_t> taken;
    folder.pieces.for_pieces_at(folder.grid.reach(block), [&](std::uint32_t n) {
        taken.clear();
        gatherer.add(read_entry(folder.manifest, folder.path, n), 0, &taken);
        for (const std::uint32_t face : taken) part.key_of_face.push_back(std::uint64_t{n} << 32 | face);
    });
    BlockChunk gathered;
    gatherer.take(gathered);
    const Chunk& chunk = gathered.chunk;
    std::vector<std::uint32_t> order(chunk.vertices.size()), number(chunk.vertices.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 &p = chunk.vertices[a].position, &q = chunk.vertices[b].position;
        return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    });
    Mesh mesh;
    mesh.reserve(chunk.vertices.size(), chunk.faces.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) {
        const ChunkVertex& vertex = chunk.vertices[order[n]];
        number[order[n]] = n;
        mesh.add_vertex(vertex.position, vertex.sides);
        part.of_vertex.push_back(folder.grid.block_at(vertex.position));
    }
    for (const ChunkFace& face : chunk.faces) {
        const auto& [v, labels] = face;
        mesh.add_face(VertexId{number[v[0]]}, VertexId{number[v[1]]}, VertexId{number[v[2]]}, labels[0], labels[1]);
        part.of_face.push_back(block_of(folder.grid, chunk, face));
        Box box;
        for (const std::uint32_t n : v) box.add(chunk.vertices[n].position);
        part.low_of_face.push_back(box.low);
    }
    folder.place(mesh);
    return mesh;
}

}  // namespace regionmesh
