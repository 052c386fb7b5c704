// Second choices: edges that were refused where they cost least.
#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "regionmesh/ids.h"

namespace regionmesh {

/// Where the best place of an edge is refused, `goes` may still go to `stays`, which stays where it is: at a cost that
/// is no less, so that its turn comes later. Cheapest first; ties go to the lower ids. The mesh may have changed since
/// an edge was added: the caller looks at it again.
class HalfCandidates {
public:
    struct Edge {
        double rank;
        VertexId goes, stays;
        friend bool operator<(const Edge& a, const Edge& b) {
            return std::tuple(a.rank, a.goes, a.stays) < std::tuple(b.rank, b.goes, b.stays);
        }
    };

    /// Holds at most so many edges.
    explicit HalfCandidates(std::size_t most) : most_(most) {}

    bool empty() const { return edges_.empty(); }
    double least_rank() const { return edges_.front().rank; }
    std::size_t bytes() const { return edges_.capacity() * sizeof(Edge); }
    void clear() { edges_.clear(); }

    /// Leaves the edge out where there is no room.
    void add(const Edge& edge) {
        if (edges_.size() == most_) return;
        edges_.push_back(edge);
        std::push_heap(edges_.begin(), edges_.end(), is_after);
    }
    Edge take() {
        std::pop_heap(edges_.begin(), edges_.end(), is_after);
        const Edge edge = edges_.back();
        edges_.pop_back();
        return edge;
    }

private:
    static bool is_after(const Edge& a, const Edge& b) { return b < a; }

    std::vector<Edge> edges_;
    std::size_t most_;
};

}  // namespace regionmesh
