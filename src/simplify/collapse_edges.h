// One mesh simplified by one queue of edges: prepass, then ranked collapses one by one (P 3.5-3.7).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "judge/judge.h"
#include "mesh/safe_interval.h"
#include "regionmesh/simplify.h"

namespace regionmesh {

/// The box in which faces may change: `safe` along an axis, everything across it.
inline Box box_of(SafeInterval safe, int axis) {
    Box box = kUnbounded;
    box.low[axis] = safe.low;
    box.high[axis] = safe.high;
    return box;
}

/// What collapses removed, by their cost: those of the prepass with the first one.
struct CostHistogram {
    struct Removed {
        std::uint32_t faces = 0, vertices = 0;
    };
    std::vector<double> costs;          // upper bounds, which rise
    std::vector<Removed> removed = {};  // one more than costs, for what is dearer

    void add(double cost, std::uint32_t faces) {
        Removed& bin = removed[std::ranges::lower_bound(costs, cost) - costs.begin()];
        bin.faces += faces;
        ++bin.vertices;
    }
};

struct CollapseBounds {
    Box limits = kUnbounded;  // faces that reach out of it stay as they are; merged vertices stay strictly inside,
                              // unless on a side of the sampled box
    bool refresh = true;      // begin again when candidates run out (P 3.7)
    CostHistogram* histogram = nullptr;  // filled; the prepass then ends at its first cost
    CollapseLog* log = nullptr;          // filled; those of the prepass have level 0
    std::uint32_t threads = 1;           // 0: one per core. Collapses are made on one, the tree and first ranks on all
    bool is_large = false;  // the mesh is far larger than the caches and near its target: collapses go along stripes of
                            // the curve of the vertices (EdgeSweeps), and are tested on all threads; boxes hold two
                            // faces, memory is 11 bytes a face less
};

struct CollapseResult {
    VerdictCounts verdicts{};     // strata: edges that cannot be candidates, counted once a refresh
    std::uint32_t refreshes = 0;  // times that the candidates were gathered after the first
    StopReason stopped = StopReason::kTarget;
    std::size_t bytes = 0;  // of the structures in addition to the mesh, at most
};

/// Collapses the cheapest edge that no verdict forbids, again and again, down to the target or up to the largest cost.
/// Fixed vertices neither move nor go; an edge that ends in one is no candidate. Quadrics are gathered from the mesh as
/// it comes and live for one call. The result does not depend on `bounds.threads`. Requires that every vertex that is
/// not fixed has all its faces in the mesh. Renumbers faces. Fast when vertices and faces lie along a curve
/// (Mesh::sort_spatially).
CollapseResult collapse_edges(Mesh& mesh, const SimplifyOptions& options, const CollapseBounds& bounds = {});

}  // namespace regionmesh
