// How far a step may take the surface from the one that decimation was given.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "judge/edge_star.h"

namespace regionmesh {

/// Every vertex has a bound (Vertex::error_bound), linear over each face. Kept true by every collapse: there is a
/// relation between the points of the surface that decimation was given and those of the surface now, each interface
/// to itself, that leaves out no point of either, and no two related points are farther apart than the bound at the
/// point of the surface now. So the largest bound of a vertex bounds the two-sided Hausdorff distance. A move is
/// bounded as a collapse without faces that vanish (gather_move), a flip by FlipBound.
///
/// A collapse relates the points of the old star to those of the new one, and only the merged vertex gets another
/// bound: the least that is at every point of the new star at least the bound at the old point plus the distance
/// between both. Bounds and positions are linear over faces, and distance is convex, so that the corners of the parts
/// on which the relation is linear decide. Interface by interface, the better of two relations:
///   far       both ends go to the merged vertex, and all faces follow: holds for any star.
///   vertical  points that are one above the other, seen along the mean normal. Requires that old and new faces cover
///             the same area once. Where a line moves, the old faces are first brought to the new line: its vertices to
///             the nearest points, and the nearest point of the edge to the merged vertex. The corners are those of the
///             overlay: each end above the new faces, the merged vertex above the old ones, and crossings of edges
///             (Bajaj and Schikore 1996).
class ErrorBound {
public:
    /// The bound that the merged vertex gets at a position. Requires set_normals and note_flat.
    double merged(const Mesh& mesh, const EdgeStar& star, Vec3 position);
    /// Sets the bounds that this makes necessary: of the merged vertex, and of those of the link that have to rise, to
    /// no more than that.
    void apply(Mesh& mesh, VertexId merged) const;

private:
    /// Seen along the mean normal from the merged vertex; z is the height.
    struct Point {
        double x = 0, y = 0, z = 0, bound = 0;
    };
    /// A face of the new star, without its corner at the merged vertex.
    struct FanFace {
        VertexId at_a, at_b;
        Point a, b;
        bool is_of_goes;
    };
    /// A face that vanishes.
    struct DeadFace {
        VertexId at_apex;
        Point apex;
        bool is_forward;  // its corners are goes, stays, apex in this order
    };
    struct Demand {
        double value, share, rest;
        std::array<VertexId, 2> others;
    };
    using OldFace = std::array<Point, 3>;
    struct Edge {
        Point from, to;
    };
    /// Of the line through a new edge with an old edge, whose ends lie on different sides of it.
    struct Crossing {
        const FanFace* face;
        const Edge* edge;
        double from, to;  // twice the areas that its ends span with the new edge
    };

    bool stays_flat(const Mesh& mesh, const EdgeStar& star) const;
    double of_interface(const Mesh& mesh, const EdgeStar& star, Vec3 position);
    double far_bound(const EdgeStar& star, Vec3 position) const;
    bool is_vertical(const Mesh& mesh, const EdgeStar& star, Vec3 position);
    bool project(const Mesh& mesh, const EdgeStar& star, Vec3 position);
    bool bring_rim();
    bool bring_vertices(const FanFace& first, const FanFace& last);
    bool bring(Point& end, const Point& rim, VertexId next);
    bool covers_once(const FanFace* first) const;
    bool put_on_new(const Point& end);
    bool put_on_old();
    bool find_old();
    bool add_old(const OldFace& face);
    static bool add_parts(const Point& a, const Point& b, const Point& c);
    void cross_edges();
    void demand(double value, double share, double rest, std::array<VertexId, 2> others);

    std::vector<int> faces_;        // of the interface: numbers in the star
    std::vector<FaceId> dead_ids_;  // and the faces that vanish
    std::vector<bool> is_done_;     // by face of the star
    std::vector<FanFace> fan_;
    std::vector<DeadFace> dead_;
    std::vector<OldFace> old_faces_;
    std::vector<Edge> old_edges_;  // inside
    std::vector<Crossing> crossings_;
    std::vector<Point*> rim_;        // ends of the edge on the old rim, from the first of the fan to the last
    VertexId split_at_ = kNoVertex;  // between it and the end next to it, a point of the rim goes to the merged vertex
    const Point* split_next_ = nullptr;
    Point goes_, stays_;  // brought to the new rim
    bool goes_is_inside_ = false, stays_is_inside_ = false, merged_is_inside_ = false;
    double goes_bound_ = 0, stays_bound_ = 0;
    std::vector<Demand> demands_;  // of all interfaces
    double needed_ = 0;            // of the merged vertex, for the interface
    double bound_ = 0;             // and for all
};

/// The bound that a flip makes necessary. Seen along the normal of both edges, the old faces and the new ones cover the
/// same area once; the corners of the overlay are the four corners, which stay, and the crossing of the edges.
struct FlipBound {
    double height = 0;  // between the old edge and the new one
    double share = 0;   // of the new edge, from c to their crossing
    double bound = 0;   // there

    /// Raises the bounds of c and d to this one, where they give less at the crossing.
    void apply(Mesh& mesh, const Flip& flip) const;
};

/// None where a face, seen so, looks down.
std::optional<FlipBound> flip_bound(const Mesh& mesh, const Flip& flip);

/// Is the bound at most `most`, as a vertex stores it?
bool is_within(double bound, double most);

/// The largest bound of a vertex.
double largest_error_bound(const Mesh& mesh);

}  // namespace regionmesh
