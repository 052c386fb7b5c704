// Sweeps of nearly free half-edge collapses before edges are ranked.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simplify/placement/placement.h"
#include "simplify/sweep/sweep_marks.h"
#include "simplify/tuning.h"

namespace regionmesh {

/// Most vertices of an unsimplified surface lie in flat places, where the order of collapses matters little. A sweep
/// visits all vertices in their order and collapses those within interfaces into a neighbour, and those of lines into
/// the next vertex of their line; the neighbour does not move. Of the neighbours that cost at most the threshold, the
/// one that leaves the best faces is taken. Several times as fast as ranked collapses: no ranks are kept, only the
/// faces of one vertex change, and vertices near in space are near in time. The tests are the same.
class Prepass {
public:
    enum class Fault {
        kSliver,  // below the quality bound
        kFold,    // beside a line, and turned over against a face of the same interface that is no smaller
    };

    /// `max_cost` is the threshold, squared length times area.
    Prepass(Judge& judge, Placement& placement, const SimplifyOptions& options, double max_cost);

    /// Returns the number of collapses, and adds the verdicts of all that were tried.
    std::uint32_t sweep(VerdictCounts& verdicts);
    /// Finds the faces with a fault.
    void find(Fault fault, std::uint32_t threads);
    /// Removes vertices of the faces that find() found and that still have the fault, up to a larger cost, as long as
    /// there are more faces than the target. Goes through them in order, or in stripes (try_in_stripes) on at most
    /// `threads` threads, which gives another result. Returns the number of collapses. Ids must be as they were.
    std::uint32_t remove(Fault fault, VerdictCounts& verdicts, bool in_stripes = false, std::uint32_t threads = 1);

private:
    struct Target {
        VertexId vertex;
        double worst_quality3;
    };

    /// To remove a vertex, or one of a face.
    struct Attempt {
        Change change = {};
        Box box = {};                     // see try_together
        VerdictCounts verdicts = {};      // of all collapses tested
        std::vector<VertexId> kept = {};  // vertices that cannot be removed
        bool is_accepted = false;         // `change`
        // Of the current vertex:
        EdgeStar around = {};                  // all its faces
        std::vector<VertexId> line_ends = {};  // its neighbours by edges between lines
        // Neighbours in its stratum that may take it, with room for one more, and what that costs.
        std::array<VertexId, kMostPrepassFaces + 1> ends = {};
        std::size_t end_count = 0;
        std::vector<HalfCost> costs = {};
        std::vector<Target> targets = {};
    };

    bool is_at_target() const { return mesh_.face_count() <= options_.target_faces; }
    bool has_fault(Fault fault, FaceId f) const;
    bool is_sliver(FaceId f) const;
    bool is_fold(FaceId f) const;
    bool may_go(VertexId v) const;
    void test_face(Fault fault, FaceId f, Attempt& attempt) const;
    void test_vertex(VertexId v, Attempt& attempt) const;
    void find_targets(VertexId v, Attempt& attempt) const;
    bool gather_ends(VertexId v, Attempt& attempt) const;
    void add_end(VertexId end, Attempt& attempt) const;
    void make(Attempt& attempt);

    Judge& judge_;
    const Mesh& mesh_;
    Placement& placement_;
    const SimplifyOptions& options_;
    double max_cost_;
    Attempt attempt_;
    std::vector<FaceId> faulty_;
    SweepMarks marks_;
};

}  // namespace regionmesh
