#include "regionmesh/mesh.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "base/parallel_for.h"
#include "base/radix_sort.h"
#include "mesh/morton_curve.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 1u << 14;  // vertices or faces of a task

[[noreturn]] void refuse(const char* what, std::uint32_t number) {
    throw Error(ErrorCode::kUsage, "mesh: there is no " + std::string(what) + ' ' + std::to_string(number) +
                                       "; it was never added, or is removed");
}

/// Sorts runs of items with equal keys by rank(index), so that the result does not depend on the order of input. Most
/// runs have two or three items.
template <class Rank>
void sort_runs(std::span<KeyedIndex> items, Rank&& rank) {
    constexpr std::ptrdiff_t kFew = 16;
    const auto is_before = [&](const KeyedIndex& a, const KeyedIndex& b) {
        const auto of_a = rank(a.index), of_b = rank(b.index);
        return of_a != of_b ? of_a < of_b : a.index < b.index;
    };
    for (auto first = items.begin(); first != items.end();) {
        auto end = first + 1;
        while (end != items.end() && end->key == first->key) ++end;
        if (end - first > kFew)
            std::sort(first, end, is_before);
        else
            for (auto next = first + 1; next < end; ++next)
                for (auto at = next; at != first && is_before(*at, *(at - 1)); --at) std::swap(*at, *(at - 1));
        first = end;
    }
}

/// Order by key, and by rank(index) where keys are equal.
template <class Rank>
void sort_by_key(std::vector<KeyedIndex>& items, std::uint32_t threads, Rank&& rank) {
    radix_sort(items, threads);
    std::vector<std::size_t> starts{0};  // starts of parts that hold whole runs of equal keys
    while (starts.back() < items.size()) {
        std::size_t at = std::min(starts.back() + kChunk, items.size());
        while (at < items.size() && items[at].key == items[at - 1].key) ++at;
        starts.push_back(at);
    }
    parallel_for(static_cast<std::uint32_t>(starts.size() - 1), threads, [&](std::uint32_t n) {
        sort_runs(std::span(items).subspan(starts[n], starts[n + 1] - starts[n]), rank);
    });
}

}  // namespace

Mesh::Mesh(Arrays arrays) {
    take(std::move(arrays));
    link_all();
}

Mesh Mesh::sorted(Arrays arrays, std::uint32_t threads, std::vector<VertexId>* new_ids) {
    Mesh mesh;
    mesh.take(std::move(arrays));
    std::vector<VertexId> ids = mesh.sort_spatially(threads);
    if (new_ids) *new_ids = std::move(ids);
    return mesh;
}

void Mesh::take(Arrays arrays) {
    vertices_ = std::move(arrays.vertices);
    faces_ = std::move(arrays.faces);
    vertex_count_ = vertices_.size();
    face_count_ = faces_.size();
}

VertexId Mesh::add_vertex(Vec3 position, SideSet sides, bool is_fixed) {
    const Vertex vertex{.position = position, .star = kNoCorner, .sides = sides, .is_fixed = is_fixed};
    if (free_vertex_ != kNoCorner) {
        const VertexId v{free_vertex_};
        free_vertex_ = vertices_[index(v)].star;
        ++vertex_count_;
        vertices_[index(v)] = vertex;
        return v;
    }
    if (vertices_.size() == kMostVertices) require_mesh_size("mesh", kMostVertices + 1, 0);
    vertices_.push_back(vertex);
    ++vertex_count_;
    return VertexId{vertices_.size() - 1};
}

FaceId Mesh::add_face(VertexId a, VertexId b, VertexId c, Label first, Label second) {
    for (const VertexId v : {a, b, c})
        if (index(v) >= vertices_.size() || !vertices_[index(v)].is_alive) refuse("vertex", index(v));
    FaceId f{free_face_};
    if (free_face_ != kNoCorner) {
        free_face_ = faces_[index(f)].next[0];
    } else {
        if (faces_.size() == kMostFaces) require_mesh_size("mesh", 0, kMostFaces + 1);
        faces_.push_back({});
        f = FaceId{faces_.size() - 1};
    }
    faces_[index(f)] = Face::between(a, b, c, first, second);
    link(f);
    ++face_count_;
    return f;
}

void Mesh::link(FaceId f) {
    Face& face = faces_[index(f)];
    for (int place = 0; place < 3; ++place) {
        Vertex& vertex = vertices_[index(face.vertices[place])];
        face.next[place] = vertex.star;
        vertex.star = index(f) << 2 | static_cast<Corner>(place);
    }
}

void Mesh::link_all() {
    for (Vertex& vertex : vertices_)
        if (vertex.is_alive) vertex.star = kNoCorner;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) link(FaceId{f});
}

void Mesh::unlink(VertexId v, Corner corner) {
    Corner* link = &vertices_[index(v)].star;
    while (*link != corner) link = &faces_[*link >> 2].next[*link & 3];
    *link = faces_[corner >> 2].next[corner & 3];
}

void Mesh::remove_face(FaceId f) {
    if (index(f) >= faces_.size() || !is_alive(f)) refuse("face", index(f));
    for (int place = 0; place < 3; ++place)
        unlink(faces_[index(f)].vertices[place], index(f) << 2 | static_cast<Corner>(place));
    Face& face = faces_[index(f)];
    face.vertices[0] = kNoVertex;
    face.next[0] = free_face_;
    free_face_ = index(f);
    --face_count_;
}

void Mesh::remove_vertex(VertexId v) {
    Vertex& vertex = vertices_[index(v)];
    assert(vertex.is_alive && vertex.star == kNoCorner);
    vertex.is_alive = false;
    vertex.star = free_vertex_;
    free_vertex_ = index(v);
    --vertex_count_;
}

void Mesh::move_star(VertexId from, VertexId to) {
    Corner last = kNoCorner;
    for (Corner c = vertices_[index(from)].star; c != kNoCorner; c = faces_[c >> 2].next[c & 3]) {
        faces_[c >> 2].vertices[c & 3] = to;
        last = c;
    }
    if (last != kNoCorner) {
        faces_[last >> 2].next[last & 3] = vertices_[index(to)].star;
        vertices_[index(to)].star = vertices_[index(from)].star;
    }
    vertices_[index(from)].star = kNoCorner;
    remove_vertex(from);
}

Mesh::Arrays Mesh::release() {
    Arrays arrays{std::move(vertices_), std::move(faces_)};
    *this = {};
    return arrays;
}

void Mesh::flip_faces() {
    for (Face& face : faces_) {
        if (face.vertices[0] == kNoVertex) continue;
        // Corners at places 1 and 2 are exchanged, and so are the links that point at them.
        std::swap(face.vertices[1], face.vertices[2]);
        std::swap(face.next[1], face.next[2]);
    }
    const auto turn = [](Corner& c) {
        if (c != kNoCorner && (c & 3) != 0) c ^= 3;
    };
    for (Face& face : faces_) {
        if (face.vertices[0] == kNoVertex) continue;
        for (Corner& c : face.next) turn(c);
    }
    for (Vertex& vertex : vertices_)
        if (vertex.is_alive) turn(vertex.star);
}

void Mesh::rename_sides(const std::array<int, 6>& names) {
    std::array<SideSet, kBoxSides + 1> renamed{};
    for (std::size_t sides = 0; sides < renamed.size(); ++sides)
        for (std::size_t side = 0; side < names.size(); ++side)
            if (sides >> side & 1) renamed[sides] |= static_cast<SideSet>(1u << names[side]);
    for (Vertex& vertex : vertices_)
        vertex.sides = static_cast<SideSet>((vertex.sides & ~kBoxSides) | renamed[vertex.sides & kBoxSides]);
    for (Face& face : faces_) {
        Label& outer = face.labels[1];
        if (face.vertices[0] == kNoVertex || !is_exterior(outer) || side_of(outer) == kHull) continue;
        outer = exterior(names[static_cast<std::size_t>(side_of(outer))]);
    }
}

std::vector<KeyedIndex> Mesh::vertices_along_curve(std::uint32_t threads) const {
    Box box;
    for (const Vertex& vertex : vertices_)
        if (vertex.is_alive) box.add(vertex.position);
    const MortonCurve curve(box);
    std::vector<KeyedIndex> order;
    order.reserve(vertex_count_);
    for (std::uint32_t v = 0; v < vertices_.size(); ++v)
        if (vertices_[v].is_alive) order.push_back({0, v});
    for_each_index(vertex_count_, kChunk, threads,
                   [&](std::uint32_t n) { order[n].key = curve(vertices_[order[n].index].position); });
    sort_by_key(order, threads, [&](std::uint32_t v) {
        const Vec3 p = vertices_[v].position;
        return std::array{p.x, p.y, p.z};
    });
    return order;
}

/// Sorts by the first of the vertices, which are already numbered along the curve, then by the others.
std::vector<KeyedIndex> Mesh::faces_along_curve(std::uint32_t threads) const {
    std::vector<KeyedIndex> order;
    order.reserve(face_count_);
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
        if (is_alive(FaceId{f}))
            order.push_back({index(*std::min_element(faces_[f].vertices.begin(), faces_[f].vertices.end())), f});
    // All faces of a run have the same lowest vertex.
    const auto both = [](std::uint32_t first, std::uint32_t second) { return std::uint64_t{first} << 32 | second; };
    sort_by_key(order, threads, [&](std::uint32_t f) {
        const auto& [a, b, c] = faces_[f].vertices;
        const auto [low, high] = std::minmax({index(a), index(b), index(c)});
        const std::uint32_t middle = index(a) ^ index(b) ^ index(c) ^ low ^ high;
        return std::pair(both(middle, high), both(faces_[f].labels[0], faces_[f].labels[1]));
    });
    return order;
}

std::vector<VertexId> Mesh::sort_spatially(std::uint32_t threads) {
    std::vector<VertexId> renumbered(vertices_.size(), kNoVertex);
    {
        const std::vector<KeyedIndex> order = vertices_along_curve(threads);
        FlatArray<Vertex> sorted;
        sorted.reserve(vertices_.size());
        sorted.resize_for_overwrite(vertex_count_);
        for_each_index(vertex_count_, kChunk, threads, [&](std::uint32_t n) {
            renumbered[order[n].index] = VertexId{n};
            sorted[n] = vertices_[order[n].index];
        });
        vertices_ = std::move(sorted);
        free_vertex_ = kNoCorner;
    }
    for_each_index(faces_.size(), kChunk, threads, [&](std::uint32_t f) {
        if (!is_alive(FaceId{f})) return;
        for (VertexId& v : faces_[f].vertices) v = renumbered[index(v)];
    });
    const std::vector<KeyedIndex> order = faces_along_curve(threads);
    FlatArray<Face> sorted;
    sorted.reserve(faces_.size());
    sorted.resize_for_overwrite(face_count_);
    for_each_index(face_count_, kChunk, threads, [&](std::uint32_t n) { sorted[n] = faces_[order[n].index]; });
    faces_ = std::move(sorted);
    free_face_ = kNoCorner;
    link_all();
    return renumbered;
}

void Mesh::compact() {
    if (vertex_count_ != vertices_.size()) {
        std::vector<VertexId> renumbered(vertices_.size(), kNoVertex);
        std::uint32_t kept = 0;
        for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
            if (!vertices_[v].is_alive) continue;
            renumbered[v] = VertexId{kept};
            vertices_[kept++] = vertices_[v];
        }
        vertices_.resize(kept);
        free_vertex_ = kNoCorner;
        for (Face& face : faces_) {
            if (face.vertices[0] == kNoVertex) continue;
            for (VertexId& v : face.vertices) v = renumbered[index(v)];
        }
    }
    if (face_count_ != faces_.size()) compact_faces();
}

void Mesh::compact_faces() {
    std::uint32_t kept = 0;
    for (const Face& face : faces_)
        if (face.vertices[0] != kNoVertex) faces_[kept++] = face;
    faces_.resize(kept);
    free_face_ = kNoCorner;
    link_all();
}

void Mesh::reserve(std::size_t vertices, std::size_t faces) {
    require_mesh_size("mesh", vertices, faces);
    vertices_.reserve(vertices);
    faces_.reserve(faces);
}

}  // namespace regionmesh
