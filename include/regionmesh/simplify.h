// The whole loop: rank the candidate edges, collapse the cheapest that no verdict forbids, refresh, stop (P 3.5-3.7).
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "regionmesh/mesh.h"
#include "regionmesh/verdict.h"

namespace regionmesh {

struct DecimateOptions {
    std::uint32_t target_faces = 0;                              // stop at this many faces or fewer
    double max_cost = std::numeric_limits<double>::infinity();   // cost level, squared length times area
    double max_error = std::numeric_limits<double>::infinity();  // rms distance to the planes gathered, in length
    double min_quality = 0.1;                                    // of modified faces; 0 for no bound
    double perturbation = 1e-7;  // largest share of scale^4 added to a cost, hashed from the edge (P 4.5)
    double scale = 1;            // length of a typical edge: the sample spacing
    bool intersect_check = true;
    bool refresh = true;  // begin again when candidates run out (P 3.7)
    Box limits{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL},
               {HUGE_VAL, HUGE_VAL, HUGE_VAL}};  // merged vertices stay strictly inside, unless on a
                                                 // side of the box, and faces that reach out stay as they
                                                 // are: beyond lies what was not read yet
    std::function<void()> on_progress = {};      // called now and then
};

enum class StopReason { kTarget, kMaxError, kTopology };

/// As reports have it: "target", "max_error", "topology".
constexpr const char* to_string(StopReason reason) {
    return reason == StopReason::kTarget ? "target" : reason == StopReason::kMaxError ? "max_error" : "topology";
}

struct DecimateResult {
    VerdictCounts verdicts{};     // strata: edges that cannot be candidates, counted once a refresh
    std::uint32_t refreshes = 0;  // times that the candidates were gathered after the first
    StopReason stopped = StopReason::kTarget;
    std::size_t bytes = 0;  // of the structures beside the model
};

/// Decimates in place. Fixed vertices neither move nor go; everything else may. Candidates are edges between vertices
/// that are not fixed. Quadrics are gathered from the model as it comes (each face a third of its area to each vertex;
/// edges of lines the planes square to each face). Deterministic. Requires that every vertex that is not fixed has all
/// its faces in the model. Renumbers faces. Fast when vertices and faces lie along a curve (Mesh::sort_spatially).
DecimateResult decimate(Mesh& mesh, const DecimateOptions& options);

}  // namespace regionmesh
