// The candidate edges of a large mesh: the cheapest part of them after the other, each along the curve of the vertices.
#pragma once

#include <cstdint>
#include <limits>

#include "regionmesh/flat_array.h"
#include "regionmesh/ids.h"

namespace regionmesh {

/// Holds for each vertex the key of the cheapest edge that it owns. A sweep visits the vertices up to a limit in order
/// of their ids, which should be a spatial order (Mesh::sort_spatially): what a collapse needs then often lies in the
/// cache already. A vertex whose key falls below the limit is visited by the same sweep if its id comes later, else by
/// the next one. What EdgeHeap does in 12 bytes a vertex, in exact order, takes 4 here.
class EdgeSweeps {
public:
    explicit EdgeSweeps(std::uint32_t vertex_end) { keys_.resize(vertex_end, kAbsent); }

    bool empty() const { return size_ == 0; }
    bool contains(VertexId v) const { return keys_[index(v)] != kAbsent; }
    float key(VertexId v) const { return keys_[index(v)]; }

    /// Goes on to the next vertex, in a new sweep where this one is at its end. A sweep is limited to the cheapest
    /// `wanted` vertices: as many as have to go, or about. Requires that not all are gone.
    void find_next(std::uint64_t wanted);
    /// The vertex found last, if nothing has changed its key since.
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

    static constexpr std::size_t kBytesPerVertex = sizeof(float);
    std::size_t bytes() const { return keys_.bytes(); }

private:
    static constexpr float kAbsent = std::numeric_limits<float>::infinity();

    float least_key(std::uint64_t rank) const;

    FlatArray<float> keys_;
    std::uint32_t at_ = 0, size_ = 0;
    float limit_ = -std::numeric_limits<float>::infinity();
};

}  // namespace regionmesh
