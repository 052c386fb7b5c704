// The candidate edges of a large mesh, in sweeps along the curve of the vertices.
#pragma once

#include <cstdint>
#include <limits>

#include "regionmesh/flat_array.h"
#include "regionmesh/ids.h"

namespace regionmesh {

/// Holds for each vertex the key of the cheapest edge that it owns. A sweep visits the vertices with keys up to a
/// limit, in order of their ids; the next sweep has a limit of its own. Ids should be in a spatial order
/// (Mesh::sort_spatially): the cache then often holds what a collapse needs. If the key of a vertex falls below the
/// limit, the same sweep visits it where its id comes later, else the next sweep. Takes 4 bytes a vertex; EdgeHeap,
/// which keeps the exact order, takes 12.
class EdgeSweeps {
public:
    explicit EdgeSweeps(std::uint32_t vertex_end) { keys_.resize(vertex_end, kAbsent); }

    bool empty() const { return size_ == 0; }
    bool contains(VertexId v) const { return keys_[index(v)] != kAbsent; }
    float key(VertexId v) const { return keys_[index(v)]; }

    /// Goes on to the next vertex; at the end of a sweep begins a new one. The limit of a new sweep is the key of the
    /// vertex in place `wanted` by cost, within bounds (kLeastSweepPart, kMostSweepPart). Requires !empty().
    void find_next(std::uint64_t wanted);
    /// The vertex that find_next() found.
    VertexId top() const { return VertexId{at_}; }

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

    float least_key(std::uint64_t rank) const;

    FlatArray<float> keys_;
    std::uint32_t at_ = 0, size_ = 0;
    float limit_ = -std::numeric_limits<float>::infinity();
};

}  // namespace regionmesh
