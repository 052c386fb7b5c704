// The edges that may be collapsed, their costs, and the queue that ranks them.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "regionmesh/simplify.h"
#include "simplify/placement/placement.h"
#include "simplify/rank/edge_queue.h"

namespace regionmesh {

/// Ranks the candidate edges of a mesh. An edge is a candidate when its label set is that of the end that goes, which
/// then owns it (where both ends qualify, their ids decide). Keeps for each vertex the cheapest edge that it owns.
class Candidates {
public:
    Candidates(const Mesh& mesh, Placement& placement, const SimplifyOptions& options, EdgeOrder order);

    /// Gathers all candidates anew, on at most `threads` threads (0: one per core). Returns the number of edges that
    /// strata forbid.
    std::uint64_t refresh(std::uint32_t threads = 1);

    bool empty() const { return queue_.empty(); }
    /// Finds the next edges. After each change, call it before next() and rank(). About `wanted` more edges have to be
    /// collapsed. Requires !empty().
    void find_next(std::uint64_t wanted) { queue_.find_next(wanted); }
    /// The ends that go of the edges found (EdgeQueue), and where they go.
    std::span<const VertexId> next() const { return queue_.next(); }
    VertexId stays(VertexId goes) const { return partner_[index(goes)]; }
    /// The largest rank that these edges may have.
    double rank() const { return queue_.limit() / key_unit_; }
    /// Whether the largest error has kept an edge out since the last refresh.
    bool has_edges_over_error() const { return has_edges_over_error_; }
    /// May v go to w, by strata? Both are alive.
    bool may_go(VertexId v, VertexId w) const;

    /// An edge that a vertex owns, by its other end.
    struct Best {
        VertexId stays = kNoVertex;
        float key = 0;
        bool is_before(Best other) const { return (key < other.key) | ((key == other.key) & (stays < other.stays)); }
    };
    /// What is seen of the edges while the cheapest are sought.
    struct Notes {
        std::uint64_t forbidden = 0;  // by strata
        bool has_edges_over_error = false;
    };
    /// What one thread needs to find the cheapest edges.
    struct Scratch {
        std::vector<VertexId> seen, owned;   // neighbours of a vertex; those whose edges it owns, and room for more
        std::vector<EdgeCost> costs;         // of these edges
        std::vector<VertexId> around;        // neighbours of a merged vertex,
        std::vector<EdgeCost> costs_around;  // and the costs of its edges
        Notes notes;
    };
    /// The cheapest edge of a vertex near a collapse.
    struct Ranked {
        VertexId goes;
        Best best;
    };

    // Ranks are found by several threads at a time, each with its own `scratch`, where Placement::ranks_in_parallel(),
    // and then noted by one.

    /// The edge of `goes` that comes after the cheapest one.
    Best after_refusal(VertexId goes, Scratch& scratch) const {
        return best(goes, {stays(goes), queue_.key(goes)}, kNoVertex, scratch);
    }
    /// Puts the cheapest edge of `goes` aside until something near it changes.
    void refuse(VertexId goes, Best after);
    /// The edges that a collapse of any edge changes: `goes` has left, and those round `stays` are ranked again.
    void rank_around(VertexId goes, VertexId stays, Scratch& scratch, std::vector<Ranked>& ranked) const;
    /// Puts these into the queue.
    void update(VertexId goes, VertexId stays, std::span<const Ranked> ranked);
    /// Takes over what was seen of the edges meanwhile, and empties `notes`.
    void note(Notes& notes) { has_edges_over_error_ |= std::exchange(notes, {}).has_edges_over_error; }

    std::size_t bytes() const;

private:
    template <class Visit>
    void for_neighbours(VertexId v, std::vector<VertexId>& seen, Visit&& visit) const;
    int edge_label_count(VertexId v, VertexId w) const;
    int label_count(VertexId v) const { return mesh_[v].label_count; }
    VertexId owner(VertexId a, VertexId b, int edge_label_count) const;
    float key(VertexId goes, VertexId stays, EdgeCost cost, Scratch& scratch) const;
    Best best(VertexId v, Best after, VertexId fresh, Scratch& scratch) const;
    void enqueue(VertexId v, Best best);

    const Mesh& mesh_;
    Placement& placement_;
    const SimplifyOptions& options_;
    FlatArray<VertexId> partner_;  // where the cheapest edge of a vertex in the queue leads
    FlatArray<float> floor_;       // edges up to this key were refused since the last change
    EdgeQueue queue_;
    bool has_edges_over_error_ = false;
    double key_unit_;  // a power of two near 1 / scale^4: keys are single precision, and would overflow or vanish
};

}  // namespace regionmesh
