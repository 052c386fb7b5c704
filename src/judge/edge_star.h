// The faces and vertices round an edge that a collapse changes.
#pragma once

#include <cstdint>
#include <vector>

#include "base/lanes.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A face of the star that survives the collapse: it keeps the corners a and b, and its third corner moves to the
/// merged vertex. The order (merged vertex, a, b) is that of the face.
struct StarFace {
    FaceId face;
    VertexId a, b;
    VertexId apex;  // which end of the edge the third corner is now
};

/// The measures of two such faces, side by side. Where their number is odd, the last stands in both lanes.
struct StarPair {
    Lanes3<Double2> a, b;        // where the corners are
    Lanes3<Double2> old_normal;  // twice the area vector before
    Double2 old_length2;         // its length, squared
    Double2 link_length2;        // of the edge from a to b, squared
    Lanes3<Double2> new_normal;  // the same after; set by set_normals
    Double2 new_length2;
};

/// What the star is of: which faces are in it, and how they change.
enum class StarKind : std::uint8_t {
    kCollapse,  // gather: all faces of both ends; `goes` and `stays` merge
    kHalf,      // gather_half: the faces of `goes`, which goes to `stays`
    kVertex,    // gather_vertex: the faces of `goes`, before its target is known
    kMove,      // gather_move: the faces of one vertex, which moves
    kFlip,      // gather_flip: the two faces that a flip makes
    kSplit,     // gather_split: the faces that a new vertex on an edge makes, which moves
};

/// The star of the edge goes-stays: reused from collapse to collapse, so that nothing is allocated in the long run.
struct EdgeStar {
    StarKind kind;
    VertexId goes, stays;
    Vec3 at_goes, at_stays;
    std::vector<StarFace> faces;
    std::vector<StarPair> pairs;
    std::vector<FaceId> dead;      // faces at the edge, which vanish
    std::vector<VertexId> apexes;  // their third corners
    std::vector<VertexId> link;    // distinct vertices a, b of the surviving faces
    Box link_box;                  // round them
    bool is_interface;             // all faces have the same two labels
    bool is_flat;                  // and lie in one plane, exactly, before and after; set by note_flat
    bool keeps_stays;              // only the faces of `goes` are here: `stays` does not move, nor do its faces change

    int face_count() const { return static_cast<int>(faces.size()); }
    Vec3 at_a(int n) const { return pairs[n / 2].a[n % 2]; }
    Vec3 at_b(int n) const { return pairs[n / 2].b[n % 2]; }
    Vec3 at_apex(int n) const { return faces[n].apex == goes ? at_goes : at_stays; }
    /// The whole star lies in a plane square to the axis, to the last bit.
    bool is_level(int axis) const {
        const double level = at_goes[axis];
        return at_stays[axis] == level && link_box.low[axis] == level && link_box.high[axis] == level;
    }
    /// Where the whole star lies in a plane square to an axis, a position in it, to the last bit.
    Vec3 kept_level(Vec3 position) const {
        for (int axis = 0; axis < 3; ++axis)
            if (is_level(axis)) position[axis] = at_goes[axis];
        return position;
    }
    Vec3 new_normal(int n) const { return pairs[n / 2].new_normal[n % 2]; }
    double new_length2(int n) const { return pairs[n / 2].new_length2[n % 2]; }
};

/// May the edge from `stays` to a vertex of the link be one of a line?
inline bool is_on_line(const Mesh& mesh, const EdgeStar& star, VertexId end) {
    return mesh[star.stays].label_count > 2 && mesh[end].label_count > 2;
}

/// Collects the star. Requires that goes-stays is an edge.
void gather(const Mesh& mesh, VertexId goes, VertexId stays, EdgeStar& star);

/// Collects all faces of a vertex that may go, before its target is known.
void gather_vertex(const Mesh& mesh, VertexId goes, EdgeStar& star);

/// Collects the faces of `goes` only. Requires that goes-stays is an edge.
void gather_half(const Mesh& mesh, VertexId goes, VertexId stays, EdgeStar& star);

/// Collects all faces of a vertex that may move: a collapse of the vertex onto itself, without dead faces.
void gather_move(const Mesh& mesh, VertexId v, EdgeStar& star);

/// The vertices of the link to which lines lead from the one that may move (gather_move).
void gather_line_ends(const Mesh& mesh, const EdgeStar& star, std::vector<VertexId>& ends);

/// An edge u-v with two faces of one interface, f = (c, u, v) and g = (d, v, u) up to rotation.
struct Flip {
    FaceId f, g;
    VertexId u, v, c, d;
};

/// Collects the two faces (c, u, d) and (c, d, v) that a flip makes, as half the collapse onto c of a vertex in the
/// middle of u-v.
void gather_flip(const Mesh& mesh, const Flip& flip, EdgeStar& star);

/// Collects the faces that vertex m makes, which has no faces yet, when it is put on the edge u-v: two of each face
/// there, which `split` gets. A move of m from where it is, on the edge.
void gather_split(const Mesh& mesh, VertexId u, VertexId v, VertexId m, EdgeStar& star, std::vector<FaceId>& split);

/// Fills in the normals that the surviving faces would have with the merged vertex at `position`.
void set_normals(EdgeStar& star, Vec3 position);

/// Notes whether all faces of the star lie in one plane, exactly, and stay there: an interface or a side of the box.
/// Where none folds, the new faces then tile the very polygon that the old ones did.
void note_flat(EdgeStar& star, Vec3 position);

}  // namespace regionmesh
