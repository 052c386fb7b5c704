#include "simplify/tiles/tile.h"

#include <algorithm>
#include <utility>

#include "simplify/tiles/mesh_chunk.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kLocked = TiledFaces::kLocked, kNone = TiledFaces::kNone;
constexpr std::uint32_t kFree = 0xFFFFFFFFu;
constexpr std::size_t kFirstRoom = 1024;

}  // namespace

void NumberTable::clear() {
    if (items_.empty()) items_.resize(kFirstRoom);
    std::fill(items_.begin(), items_.end(), KeyedIndex{kFree, kNone});
    used_ = 0;
}

std::size_t NumberTable::find(std::uint32_t key) const {
    const std::size_t mask = items_.size() - 1;
    std::size_t at = (key * 0x9E3779B1u >> 7) & mask;
    while (items_[at].key != key && items_[at].key != kFree) at = (at + 1) & mask;
    return at;
}

std::uint32_t& NumberTable::operator[](std::uint32_t key) {
    std::size_t at = find(key);
    if (items_[at].key == kFree) {
        if (++used_ * 2 > items_.size()) {
            grow();
            at = find(key);
        }
        items_[at].key = key;
    }
    return items_[at].index;
}

void NumberTable::grow() {
    std::vector<KeyedIndex> old(items_.size() * 2, {kFree, kNone});
    old.swap(items_);
    for (const KeyedIndex& item : old)
        if (item.key != kFree) items_[find(item.key)] = item;
}

void Tile::take_out(TiledFaces& faces, std::uint32_t tile) {
    const auto own = faces.faces_of(tile);
    const auto halo = faces.halo_of(tile);
    Mesh::Arrays arrays;
    arrays.vertices.reserve((own.size() + halo.size()) * 5 / 8);
    arrays.faces.reserve(own.size() + halo.size());
    inside_count_ = 0;
    locals_.clear();
    locked_.clear();
    for (std::uint32_t f : own) put_in(faces, f, arrays);
    for (const KeyedIndex& face : halo) put_in(faces, face.index, arrays);
    mesh_ = Mesh::sorted(std::move(arrays), 1, &sorted_);
}

void Tile::put_in(TiledFaces& faces, std::uint32_t f, Mesh::Arrays& arrays) {
    const ChunkFace& face = faces.chunk().faces[f];
    std::array<VertexId, 3> corner;
    for (int c = 0; c < 3; ++c) {
        const std::uint32_t local = face.vertices[c];
        const bool is_locked = faces.is_locked(local);
        std::uint32_t& place = is_locked ? locked_[local] : faces.place(local);
        if (place == kNone) {
            place = arrays.vertices.size();
            arrays.vertices.push_back(mesh_vertex(faces.vertex(local), is_locked));
            locals_.push_back(local);
            inside_count_ += !is_locked;
        }
        corner[c] = VertexId{place};
    }
    arrays.faces.push_back(Face::between(corner[0], corner[1], corner[2], face.labels[0], face.labels[1]));
}

/// A face with three locked vertices has not changed, and may be in several tiles: the one that it belongs to keeps it.
void Tile::note_left(TiledFaces& faces, std::uint32_t tile) {
    left_vertices_.clear();
    left_faces_.clear();
    left_bounds_.clear();
    const auto is_locked = [&](std::uint32_t local) { return faces.is_locked(local); };
    for (std::uint32_t f : faces.faces_of(tile)) {
        ChunkFace face = faces.chunk().faces[f];
        if (!std::all_of(face.vertices.begin(), face.vertices.end(), is_locked)) continue;
        for (std::uint32_t& v : face.vertices) v = kLocked | faces.locked_number(v);
        left_faces_.push_back(face);
    }
    number_.assign(mesh_.vertex_end(), kNone);
    for (std::uint32_t n = 0; n < locals_.size(); ++n) {
        const std::uint32_t local = locals_[n];
        if (!faces.is_locked(local)) {
            faces.place(local) = kNone;
            continue;
        }
        number_[index(sorted_[n])] = kLocked | faces.locked_number(local);
        const float bound = mesh_[sorted_[n]].error_bound();
        if (bound > faces.vertex(local).error_bound) left_bounds_.push_back({faces.locked_number(local), bound});
    }
    for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
        if (!mesh_.is_alive(FaceId{f})) continue;
        const auto& corners = mesh_[FaceId{f}].vertices;
        ChunkFace face{{}, mesh_[FaceId{f}].labels};
        std::uint32_t all_locked = kLocked;
        for (int c = 0; c < 3; ++c) {
            std::uint32_t& number = number_[index(corners[c])];
            if (number == kNone) {
                number = static_cast<std::uint32_t>(left_vertices_.size());
                const Vertex& vertex = mesh_[corners[c]];
                left_vertices_.push_back({vertex.position, vertex.sides, vertex.error_bound()});
            }
            face.vertices[c] = number;
            all_locked &= number;
        }
        if (all_locked == 0) left_faces_.push_back(face);
    }
    mesh_ = {};  // the tile may wait long until those before it are put back
}

void Tile::put_back(Chunk& made) const {
    for (const auto& [number, bound] : left_bounds_) made.raise_bound(number, bound);
    const std::uint32_t first = made.carried + static_cast<std::uint32_t>(made.vertices.size());
    made.vertices.insert(made.vertices.end(), left_vertices_.begin(), left_vertices_.end());
    for (const ChunkFace& left : left_faces_) {
        ChunkFace& face = made.faces.emplace_back(left);
        for (std::uint32_t& v : face.vertices) v = (v & kLocked) != 0 ? v & ~kLocked : first + v;
    }
}

}  // namespace regionmesh
