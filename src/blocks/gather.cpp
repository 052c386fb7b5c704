#include "blocks/gather.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>

#include "base/box.h"
#include "base/hash.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kNone = ~0u;

std::array<Vec3, 3> corners_of(const Piece& piece, const PieceFace& face) {
    const auto& v = face.vertices;
    return {piece.vertices[v[0]].position, piece.vertices[v[1]].position, piece.vertices[v[2]].position};
}

}  // namespace

std::uint32_t block_of(const BlockGrid& grid, const std::array<Vec3, 3>& corners) {
    Vec3 centroid;
    for (int axis = 0; axis < 3; ++axis) {
        std::array<double, 3> along{corners[0][axis], corners[1][axis], corners[2][axis]};
        std::sort(along.begin(), along.end());
        centroid[axis] = (along[0] + along[1] + along[2]) / 3;
    }
    return grid.block_at(centroid);
}

std::uint32_t block_of(const BlockGrid& grid, const Chunk& chunk, const ChunkFace& face) {
    const auto& v = face.vertices;
    return block_of(grid,
                    {chunk.vertices[v[0]].position, chunk.vertices[v[1]].position, chunk.vertices[v[2]].position});
}

PositionBits bits_of(Vec3 position) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    return {bits(position.x), bits(position.y), bits(position.z)};
}

std::size_t PositionHash::operator()(const PositionBits& bits) const {
    return mix64(mix64(mix64(bits[0]) ^ bits[1]) ^ bits[2]);
}

std::uint32_t SharedVertices::number(Vec3 position, std::uint32_t next) {
    return numbers_.try_emplace(bits_of(position), next).first->second;
}

std::uint32_t BlockGatherer::number(const PieceVertex& vertex, std::uint32_t& place) {
    if (place != kNone) return place;
    const auto next = static_cast<std::uint32_t>(chunk_.vertices.size());
    place = vertex.is_shared ? shared_.number(vertex.position, next) : next;
    if (place == next) {
        chunk_.vertices.push_back({vertex.position, vertex.sides, vertex.error_bound});
        is_locked_.push_back(false);
    }
    float& bound = chunk_.vertices[place].error_bound;
    bound = std::max(bound, vertex.error_bound);
    return place;
}

void BlockGatherer::add(const Piece& piece, double keep, std::vector<std::uint32_t>* taken) {
    std::vector<std::uint32_t> places(piece.vertices.size(), kNone);
    for (const PieceFace& face : piece.faces) {
        const std::array<Vec3, 3> corners = corners_of(piece, face);
        const Box box = box_of(corners);
        if (!overlap(box, reach_)) continue;
        const bool is_own = block_of(grid_, corners) == block_;
        ChunkFace made{{}, face.labels};
        for (int n = 0; n < 3; ++n)
            made.vertices[n] = number(piece.vertices[face.vertices[n]], places[face.vertices[n]]);
        chunk_.faces.push_back(made);
        if (taken) taken->push_back(static_cast<std::uint32_t>(&face - piece.faces.data()));
        if (!is_own || !is_within(box, limits_))
            for (const std::uint32_t v : made.vertices) is_locked_[v] = true;
        if (is_own)
            goal_ += keep;
        else
            ++other_faces_;
    }
}

void BlockGatherer::take(BlockChunk& block) {
    for (std::uint32_t v = 0; v < is_locked_.size(); ++v)
        if (is_locked_[v]) chunk_.active.push_back(v);
    block.chunk = std::move(chunk_);
    block.other_faces = other_faces_;
}

std::vector<std::uint32_t> longest_first(const BlockGrid& blocks, const PieceMap& map,
                                         std::span<const PieceHeader> pieces) {
    std::vector<std::uint64_t> faces(blocks.count());
    for (std::uint32_t block = 0; block < blocks.count(); ++block)
        map.for_pieces_at(blocks.reach(block), [&](std::uint32_t piece) { faces[block] += pieces[piece].faces; });
    std::vector<std::uint32_t> order(blocks.count());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::uint32_t block) { return faces[block]; });
    return order;
}

Piece piece_of(const BlockChunk& block, const BlockGrid& grid, const PieceHeader& header) {
    const Chunk& chunk = block.chunk;
    std::vector<bool> is_shared(chunk.vertices.size());
    for (const std::uint32_t v : chunk.active) is_shared[v] = true;
    std::vector<std::uint32_t> numbers(chunk.vertices.size(), kNone);
    Piece piece{header, {}, {}, block.log};
    for (const ChunkFace& of_chunk : chunk.faces) {
        if (block_of(grid, chunk, of_chunk) != header.block) continue;
        const auto& v = of_chunk.vertices;
        PieceFace face{{}, of_chunk.labels};
        for (int n = 0; n < 3; ++n) {
            std::uint32_t& number = numbers[v[n]];
            if (number == kNone) {
                number = static_cast<std::uint32_t>(piece.vertices.size());
                const ChunkVertex& vertex = chunk.vertices[v[n]];
                piece.vertices.push_back({vertex.position, vertex.error_bound, vertex.sides, is_shared[v[n]]});
            }
            face.vertices[n] = number;
        }
        piece.faces.push_back(face);
    }
    for (LoggedCollapse& collapse : piece.log) {
        collapse.goes = numbers[collapse.goes];
        collapse.stays = numbers[collapse.stays];
    }
    return piece;
}

}  // namespace regionmesh
