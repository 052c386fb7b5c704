// The multi-region surface mesh: vertices, faces with two labels, and the star of each vertex.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "regionmesh/flat_array.h"
#include "regionmesh/ids.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct KeyedIndex;

/// A corner is a face and one of its three places, packed: face * 4 + place. Corners thread the star of a vertex.
using Corner = std::uint32_t;
inline constexpr Corner kNoCorner = 0xFFFFFFFFu;

/// The places of the next and the previous corner of a face, in its orientation. Without a branch, which would be
/// mispredicted: two bits for each place.
constexpr int place_after(int place) { return 0b00'10'01 >> 2 * place & 3; }
constexpr int place_before(int place) { return 0b01'00'10 >> 2 * place & 3; }

/// 32 bytes, half a cache line: a walk around a star touches one cache line per face.
struct Face {
    std::array<VertexId, 3>
        vertices;                // counter-clockwise seen from the second label: the normal points from first to second
    std::array<Corner, 3> next;  // next corner in the star of the vertex at the same place
    std::array<Label, 2> labels;  // the smaller dense label first

    /// The same as labels == others, but inline: that comparison calls memcmp.
    bool has_labels(const std::array<Label, 2>& others) const {
        return labels[0] == others[0] && labels[1] == others[1];
    }

    /// In no star yet. The normal of a, b, c points from region `first` to region `second`.
    static Face between(VertexId a, VertexId b, VertexId c, Label first, Label second) {
        if (first > second) return between(a, c, b, second, first);
        return {.vertices = {a, b, c}, .next = {kNoCorner, kNoCorner, kNoCorner}, .labels = {first, second}};
    }
};
static_assert(sizeof(Face) == 32);

/// 32 bytes.
struct Vertex {
    Vec3 position;
    Corner star = kNoCorner;  // first corner of the star
    SideSet sides = 0;        // sides of the box it lies on; it keeps its coordinate across each of them
    bool is_fixed : 1 =
        false;  // neither moved nor removed: some of its faces are in another tile, block or strip, or broken
    bool is_alive : 1 = true;
    std::uint8_t label_count : 5 = 0;  // labels of its stratum; while simplifying (src/simplify/rank/candidates.h)
    std::uint32_t bound_bits : 17 = 0;

    /// How far the faces round it may be from the surface that decimation was given, and that from them: a length at
    /// this corner of each face, linear in between (docs/explanation/decimate.md).
    float error_bound() const { return std::bit_cast<float>(std::uint32_t{bound_bits} << kBoundShift); }
    /// Stores the least number with 9 bits of mantissa that is not below `bound`, which is at least 0.
    void set_error_bound(double bound) {
        auto rounded = static_cast<float>(bound);
        if (rounded < bound) rounded = std::nextafter(rounded, HUGE_VALF);
        bound_bits = ((std::bit_cast<std::uint32_t>(rounded) + kBoundMask) >> kBoundShift) & 0x1FFFFu;
    }

private:
    static constexpr int kBoundShift = 14;
    static constexpr std::uint32_t kBoundMask = (1u << kBoundShift) - 1;
};
static_assert(sizeof(Vertex) == 32);

/// Flat arrays with free places, which are reused (P 3.3). An id stays valid until its vertex or face is removed or
/// renumbered. To visit all, iterate over [0, vertex_end()) or [0, face_end()) and skip those that are not alive.
class Mesh {
public:
    /// Vertices and faces, by id.
    struct Arrays {
        FlatArray<Vertex> vertices;
        FlatArray<Face> faces;
    };

    Mesh() = default;
    /// Requires arrays without free places. Makes all stars anew: those of the arrays need no value.
    explicit Mesh(Arrays arrays);
    /// The same, sorted; `new_ids` becomes what sort_spatially() returns.
    static Mesh sorted(Arrays arrays, std::uint32_t threads = 1, std::vector<VertexId>* new_ids = nullptr);
    /// Leave the other mesh empty.
    Mesh(Mesh&& other) noexcept { swap(other); }
    Mesh& operator=(Mesh&& other) noexcept {
        Mesh moved(std::move(other));
        swap(moved);
        return *this;
    }

    /// Throws Error(kInput) beyond kMostVertices (limits.h).
    VertexId add_vertex(Vec3 position, SideSet sides = 0, bool is_fixed = false);
    /// The normal of a, b, c points from region `first` to region `second`. Stored with the smaller label first, so
    /// that all faces of an interface have the same orientation. Throws Error(kInput) beyond kMostFaces (limits.h),
    /// Error(kUsage) for a vertex that does not exist.
    FaceId add_face(VertexId a, VertexId b, VertexId c, Label first, Label second);
    /// Removes the face from the stars of its vertices; the vertices stay. Throws Error(kUsage) for a face that does
    /// not exist.
    void remove_face(FaceId f);
    /// Requires an empty star.
    void remove_vertex(VertexId v);
    /// Replaces `from` by `to` in every face of `from`, and removes `from`.
    void move_star(VertexId from, VertexId to);

    std::uint32_t vertex_count() const { return vertex_count_; }
    std::uint32_t face_count() const { return face_count_; }
    std::uint32_t vertex_end() const { return vertices_.size(); }
    std::uint32_t face_end() const { return faces_.size(); }
    bool is_alive(VertexId v) const { return vertices_[index(v)].is_alive; }
    bool is_alive(FaceId f) const { return faces_[index(f)].vertices[0] != kNoVertex; }

    const Face& operator[](FaceId f) const { return faces_[index(f)]; }
    const Vertex& operator[](VertexId v) const { return vertices_[index(v)]; }
    Vertex& operator[](VertexId v) { return vertices_[index(v)]; }
    Vec3 position(VertexId v) const { return vertices_[index(v)].position; }
    std::array<Vec3, 3> corners(FaceId f) const {
        const Face& face = faces_[index(f)];
        return {position(face.vertices[0]), position(face.vertices[1]), position(face.vertices[2])};
    }

    /// Calls visit(FaceId, int place) for every face of the star of v. Requires that the star does not change
    /// meanwhile.
    template <class Visit>
    void for_star(VertexId v, Visit&& visit) const {
        for (Corner c = vertices_[index(v)].star; c != kNoCorner;) {
            const Face& face = faces_[c >> 2];
            const Corner place = c & 3;
            visit(FaceId{c >> 2}, static_cast<int>(place));
            c = face.next[place];
        }
    }

    /// Renumbers vertices and faces along a Morton curve, without free places, so that neighbours in space are
    /// neighbours in memory. The result does not depend on the order before. Returns the new id of each old vertex
    /// (kNoVertex for free places). Needs memory for a second copy. On at most `threads` threads (0: one per core).
    std::vector<VertexId> sort_spatially(std::uint32_t threads = 1);
    /// Renumbers vertices and faces without free places, keeping their order: afterwards ids are the numbers of points
    /// and faces in written files and exported arrays.
    void compact();
    /// The same for faces only.
    void compact_faces();

    /// The arrays, with free places in between. Empties the mesh.
    Arrays release();

    /// Reverses the orientation of all faces; labels stay. For a map of the positions that mirrors.
    void flip_faces();

    /// Renames side s of the box to `names[s]`, of vertices and of faces with its exterior. For a map of the positions
    /// that permutes the sides.
    void rename_sides(const std::array<int, 6>& names);

    /// Bytes of the arrays.
    std::size_t bytes() const { return vertices_.bytes() + faces_.bytes(); }
    /// Throws Error(kInput) beyond the limits of limits.h.
    void reserve(std::size_t vertices, std::size_t faces);

private:
    void swap(Mesh& other) noexcept {
        std::swap(vertices_, other.vertices_);
        std::swap(faces_, other.faces_);
        std::swap(vertex_count_, other.vertex_count_);
        std::swap(face_count_, other.face_count_);
        std::swap(free_vertex_, other.free_vertex_);
        std::swap(free_face_, other.free_face_);
    }
    void unlink(VertexId v, Corner corner);
    void link(FaceId f);
    void take(Arrays arrays);
    void link_all();
    std::vector<KeyedIndex> vertices_along_curve(std::uint32_t threads) const;
    std::vector<KeyedIndex> faces_along_curve(std::uint32_t threads) const;

    FlatArray<Vertex> vertices_;
    FlatArray<Face> faces_;
    std::uint32_t vertex_count_ = 0;
    std::uint32_t face_count_ = 0;
    Corner free_vertex_ = kNoCorner;  // heads of the lists of free places, threaded through star and next[0]
    Corner free_face_ = kNoCorner;
};

/// Edge length of an equilateral face of mean area; 1 for a mesh without faces. Stands for the sample spacing of a mesh
/// that comes without one.
double typical_edge(const Mesh& mesh);

}  // namespace regionmesh
