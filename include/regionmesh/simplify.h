// Fewer faces, the same regions: the whole loop on all threads (P 3.5-3.7).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>

#include "regionmesh/mesh.h"
#include "regionmesh/promises.h"

namespace regionmesh {

/// Where a merged vertex goes, and what ranks its edge.
///   quadric         the least sum of squared distances to the planes gathered (Garland and Heckbert 1997).
///   lindstrom-turk  the volumes of all regions stay, and the squared volume swept is least; nothing is kept from one
///                   collapse to the next (Lindstrom and Turk 1998, 1999).
enum class PlacementKind { kQuadric, kLindstromTurk };
inline constexpr std::array<const char*, 2> kPlacementNames{"quadric", "lindstrom-turk"};

struct SimplifyOptions {
    std::uint32_t target_faces = 0;                             // stop at this number of faces or fewer
    double max_cost = std::numeric_limits<double>::infinity();  // threshold: squared length times area
    Promises promises = {};
    double perturbation = 1e-7;   // largest share of scale^4 added to a cost, hashed from the edge (P 4.5)
    bool bounds_regions = false;  // asserts that each face has its first label behind it and its second in front of
                                  // it, everywhere; collapses are then tested faster, with the same result
    bool removes_folds = false;   // faces beside lines that are turned over, as smoothing inside the lattice leaves
                                  // them, go early, at a cost of up to scale^4
    PlacementKind placement = PlacementKind::kQuadric;
    std::uint32_t threads = 0;  // at work at a time; 0: one per core. The result is the same
    /// Called now and then, on the calling thread, with the number of faces that are left; while tiles are simplified,
    /// with that before each of the two stages.
    std::function<void(std::uint64_t faces)> on_progress = {};
};

struct SimplifyResult {
    VerdictCounts verdicts{};       // strata: edges that cannot be candidates, counted once a refresh
    std::uint32_t tile_passes = 0;  // passes over the mesh tile by tile
    std::uint32_t refreshes = 0;    // times that the candidates of the last trim were gathered after the first
    StopReason stopped = StopReason::kTarget;
    double error_bound = 0;  // no point of either surface is farther than this from the other
    std::size_t bytes = 0;   // held at most, the mesh included
};

/// Simplifies in place: large meshes tile by tile on all threads, up to a threshold that leaves a little more than the
/// target; then the whole mesh on one thread, cheapest edge first, down to the target (docs/explanation/decimate.md,
/// docs/explanation/tiles.md). Fixed vertices (Vertex::is_fixed) neither move nor go, and no edge that ends in one is
/// collapsed; everything else may. A target below what topology and quality allow is not reached; `stopped` says why.
/// Renumbers vertices and faces. Deterministic: the result depends on the mesh and the options, not on `threads`.
/// `max_error` bounds the two-sided Hausdorff distance of each interface to the same interface of the mesh as it comes.
/// Requires that every vertex that is not fixed has all its faces in the mesh. Throws Error(kUsage) for numbers out of
/// range and for a mesh or samples that are oblique (box_axes.h), and Error(kInput) for `samples` that are no lattice.
SimplifyResult simplify(Mesh& mesh, const SimplifyOptions& options);

}  // namespace regionmesh
