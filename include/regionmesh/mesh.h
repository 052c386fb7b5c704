// The multi-region surface model: vertices, faces with two labels, and the star of each vertex.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "regionmesh/flat_array.h"
#include "regionmesh/ids.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct KeyedIndex;

/// A corner is a face and one of its three places, packed: face * 4 + place. It threads the star of a vertex.
using Corner = std::uint32_t;
inline constexpr Corner kNoCorner = 0xFFFFFFFFu;

/// 32 bytes, half a cache line: going round a star touches one line a face.
struct Face {
    std::array<VertexId, 3>
        vertices;                // counter-clockwise seen from the second label: the normal points from first to second
    std::array<Corner, 3> next;  // next corner in the star of the vertex at the same place
    std::array<Label, 2> labels;  // the smaller dense label first
};
static_assert(sizeof(Face) == 32);

/// 32 bytes.
struct Vertex {
    Vec3 position;
    Corner star = kNoCorner;  // first corner of the star
    SideSet sides = 0;        // sides of the box it lies on; there it keeps its coordinate
    bool is_fixed = false;    // some of its faces are not here (front, seam): it neither moves nor goes
    bool is_alive = true;
    std::uint8_t label_count = 0;  // of its stratum; kept while decimating (decimate/candidates.h)
};
static_assert(sizeof(Vertex) == 32);

/// Flat arrays with free places, which are reused (P 3.3). Ids stay valid until the thing they name is removed
/// or renumbered.
/// Iterate over [0, vertex_end()) or [0, face_end()) and skip what is not alive.
class Mesh {
public:
    VertexId add_vertex(Vec3 position, SideSet sides = 0, bool is_fixed = false);
    /// The normal of a, b, c points from first to second; stored with the smaller label first, so that all faces of an
    /// interface look the same way.
    FaceId add_face(VertexId a, VertexId b, VertexId c, Label first, Label second);
    /// Takes the face out of the stars of its vertices; the vertices stay.
    void remove_face(FaceId f);
    /// Requires an empty star.
    void remove_vertex(VertexId v);
    /// Gives every face of `from` to `to` in its place, and removes `from`.
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

    /// Calls visit(FaceId, int place) for every face of the star of v; the star must not change meanwhile.
    template <class Visit>
    void for_star(VertexId v, Visit&& visit) const {
        for (Corner c = vertices_[index(v)].star; c != kNoCorner;) {
            const Face& face = faces_[c >> 2];
            const int place = static_cast<int>(c & 3);
            visit(FaceId{c >> 2}, place);
            c = face.next[place];
        }
    }

    /// Renumbers vertices and faces along a Morton curve, without free places: what is near in space is near in memory,
    /// and in FaceTree. The order does not depend on what it was before. Returns the new id of each old vertex
    /// (kNoVertex for free places). Holds a second copy meanwhile.
    std::vector<VertexId> sort_spatially();
    /// Renumbers faces only, in their order, without free places.
    void compact_faces();

    /// Turns all faces round and exchanges nothing else: for a mirroring map of the positions.
    void flip_faces();

    /// Bytes held by the arrays.
    std::size_t bytes() const { return vertices_.bytes() + faces_.bytes(); }
    void reserve(std::size_t vertices, std::size_t faces);

private:
    void unlink(VertexId v, Corner corner);
    void link(FaceId f);
    std::vector<KeyedIndex> vertices_along_curve() const;
    std::vector<KeyedIndex> faces_along_curve() const;

    FlatArray<Vertex> vertices_;
    FlatArray<Face> faces_;
    std::uint32_t vertex_count_ = 0;
    std::uint32_t face_count_ = 0;
    Corner free_vertex_ = kNoCorner;  // heads of the lists of free places, threaded through star and next[0]
    Corner free_face_ = kNoCorner;
};

}  // namespace regionmesh
