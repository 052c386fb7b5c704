// The candidate edges in the order in which they are tried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "simplify/rank/edge_heap.h"
#include "simplify/rank/edge_sweeps.h"

namespace regionmesh {

enum class EdgeOrder : std::uint8_t {
    kByCost,    // the cheapest first (EdgeHeap)
    kInSweeps,  // the cheapest ones along stripes of the curve of the vertices, then the next ones (EdgeSweeps)
};

/// Vertices with the key of the cheapest edge that each owns, in one of two orders.
class EdgeQueue {
public:
    EdgeQueue(std::uint32_t vertex_end, EdgeOrder order)
        : is_heap_(order == EdgeOrder::kByCost), heap_(is_heap_ ? vertex_end : 0), sweeps_(is_heap_ ? 0 : vertex_end) {}

    bool empty() const { return is_heap_ ? heap_.empty() : sweeps_.empty(); }
    float key(VertexId v) const { return is_heap_ ? heap_.key(v) : sweeps_.key(v); }
    void set(VertexId v, float key) { is_heap_ ? heap_.set(v, key) : sweeps_.set(v, key); }
    void remove(VertexId v) { is_heap_ ? heap_.remove(v) : sweeps_.remove(v); }

    /// Finds the next vertices. Call it before next() and limit() after each change. About `wanted` more vertices have
    /// to go. Requires !empty().
    void find_next(std::uint64_t wanted) {
        if (is_heap_)
            top_ = heap_.top();
        else
            sweeps_.find_next(wanted);
    }
    /// One in kByCost.
    std::span<const VertexId> next() const { return is_heap_ ? std::span(&top_, 1) : sweeps_.next(); }
    /// The largest key that they may have.
    float limit() const { return is_heap_ ? heap_.top_key() : sweeps_.limit(); }

    std::size_t bytes() const { return heap_.bytes() + sweeps_.bytes(); }

private:
    bool is_heap_;
    VertexId top_ = kNoVertex;
    EdgeHeap heap_;
    EdgeSweeps sweeps_;
};

}  // namespace regionmesh
