// Better shaped faces, the same surface: flips of edges and moves of vertices, for finite elements.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/promises.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct ImproveOptions {
    Promises promises = {};     // round faces below the bound on quality, the surface may move farther and edges be
                                // collapsed; max_error limits ImproveResult::error_bound
    double tolerance = 0.1;     // share of the scale by which the surface may move, all steps together; three times as
                                // much round faces below the bound
    std::uint32_t sweeps = 12;  // most sweeps over all edges and vertices
    std::function<void()> on_progress = {};  // called now and then, on the calling thread
};

/// The shape of all faces of a mesh. Angles are in degrees; all are 0 for a mesh without faces.
struct FaceShapes {
    double min_quality = 0, mean_quality = 0;
    double min_angle = 0, max_angle = 0;
    std::uint64_t faces_below = 0;  // of lower quality than asked
};

struct ImproveResult {
    std::uint64_t flips = 0, moves = 0, collapses = 0;
    std::uint32_t sweeps = 0;
    FaceShapes before, after;
    double error_bound = 0;  // of simplify() and this together (SimplifyResult)
};

/// Flips edges inside interfaces, moves vertices within their stratum (along interfaces and sides of the box, along
/// lines; quadruple points, corners of the box and fixed vertices stay), and collapses edges of faces below the bound
/// on quality. Each step keeps the promises, but for quality: it lowers no worst quality and lowers the sum of 1 /
/// quality^3 of the faces that it changes, in which the worst faces count most. So no violation is added, and the worst
/// quality of the mesh never falls. Deterministic. Requires that every vertex that is not fixed has all its faces in
/// the mesh. Renumbers vertices and faces. Throws like simplify().
ImproveResult improve(Mesh& mesh, const ImproveOptions& options);

/// What was done about faces below the bound on quality.
struct FloorResult {
    std::uint64_t collapses = 0, flips = 0, moves = 0, splits = 0;
    std::uint64_t below_before = 0, below_after = 0;  // faces
    double lowest_before = 0, lowest_after = 0;       // quality; 0 for a mesh without faces
    double error_bound = 0;                           // of simplify() and this together (SimplifyResult)
    std::vector<Vec3> left = {};                      // middles of the first kMostLeft faces still below
    static constexpr std::size_t kMostLeft = 100;

    /// This and what was done later as one.
    void follow(const FloorResult& later) {
        collapses += later.collapses;
        flips += later.flips;
        moves += later.moves;
        splits += later.splits;
        below_after = later.below_after;
        lowest_after = later.lowest_after;
        error_bound = later.error_bound;
        left = later.left;
    }
};

/// Raises the faces below the bound on quality (P 4.3): each gets every cure that the promises allow, a collapse of one
/// of its edges, a flip, a move of a corner within its stratum, a split of its longest edge, in rounds until none
/// helps. Each step lowers no worst quality, so that no other face gets below. Faces stay below where topology or
/// samples hold all of their corners. May leave a few faces more than there were. Deterministic; requires and throws
/// what improve() does.
FloorResult raise_floor(Mesh& mesh, const Promises& promises);

}  // namespace regionmesh
