// The candidate edges of a large mesh, in sweeps along the curve of the vertices.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "regionmesh/flat_array.h"
#include "regionmesh/ids.h"

namespace regionmesh {

/// Holds for each vertex the key of the cheapest edge that it owns. A sweep visits the vertices with keys up to a
/// limit. It parts the ids into stripes with about as many of them each, at most kMostStripes, and goes along all
/// stripes side by side, in each in order of the ids. Ids should be in a spatial order (Mesh::sort_spatially): the next
/// vertices of the stripes then nearly always lie far apart, so that their edges may be tested at the same time, and
/// the cache often holds what a collapse needs. If the key of a vertex falls below the limit, the same sweep visits it
/// where its stripe has not passed it, else the next sweep. Takes 4 bytes a vertex; EdgeHeap, which keeps the exact
/// order, takes 12.
class EdgeSweeps {
public:
    explicit EdgeSweeps(std::uint32_t vertex_end) { keys_.resize(vertex_end, kAbsent); }

    bool empty() const { return size_ == 0; }
    bool contains(VertexId v) const { return keys_[index(v)] != kAbsent; }
    float key(VertexId v) const { return keys_[index(v)]; }

    /// Goes on to the next vertex of each stripe; at the end of a sweep begins a new one. The limit of a new sweep is
    /// the key of the vertex in place `wanted` by cost, within bounds (kLeastSweepPart, kMostSweepPart). Requires
    /// !empty().
    void find_next(std::uint64_t wanted);
    /// The vertices that find_next() found: one of each stripe that has one left, in order of the stripes.
    std::span<const VertexId> next() const { return next_; }
    /// No vertex of next() has a larger key.
    float limit() const { return limit_; }

    /// Inserts v, or changes its key, which must be finite.
    void set(VertexId v, float key) {
        size_ += !contains(v);
        keys_[index(v)] = key;
    }
    /// Takes v out if it is in.
    void remove(VertexId v) {
        size_ -= contains(v);
        keys_[index(v)] = kAbsent;
    }

    std::size_t bytes() const { return keys_.bytes(); }

private:
    static constexpr float kAbsent = std::numeric_limits<float>::infinity();

    struct Stripe {
        std::uint32_t at, end;
    };

    void begin_sweep(std::uint64_t wanted);
    float least_key(std::uint64_t rank) const;

    FlatArray<float> keys_;
    std::vector<Stripe> stripes_;
    std::vector<VertexId> next_;
    std::uint32_t size_ = 0;
    float limit_ = -std::numeric_limits<float>::infinity();
};

}  // namespace regionmesh
