// The quadric of each vertex.
#pragma once

#include "regionmesh/flat_array.h"
#include "regionmesh/mesh.h"
#include "simplify/placement/least_cost.h"

namespace regionmesh {

/// Gathered from the mesh as it comes: each face gives a third of its area to each vertex; edges of lines give the
/// planes square to each face (Garland and Heckbert 1997). Each is relative to its vertex.
class VertexQuadrics {
public:
    /// Requires the label counts of the vertices (count_labels). On at most `threads` threads (0: one per core).
    explicit VertexQuadrics(const Mesh& mesh, std::uint32_t threads = 1);

    const PackedQuadric& operator[](VertexId v) const { return quadrics_[index(v)]; }
    EdgeEnds ends(const Mesh& mesh, VertexId goes, VertexId stays) const {
        return {mesh.position(goes), mesh.position(stays), quadrics_[index(goes)], quadrics_[index(stays)],
                mesh[stays].sides};
    }
    /// Before the star changes: `stays` moves to `position` and takes over what `goes` has.
    void merge(const Mesh& mesh, VertexId goes, VertexId stays, Vec3 position) {
        quadrics_[index(stays)] = PackedQuadric(merged_quadric(ends(mesh, goes, stays), position));
    }
    std::size_t bytes() const { return quadrics_.bytes(); }

private:
    /// `count` vertex ids from `first` on.
    struct Part {
        std::uint32_t first, count;
        bool has(VertexId v) const { return index(v) - first < count; }
    };
    void gather(const Mesh& mesh, Part part);
    void add_plane(VertexId v, Vec3 normal, double weight);
    void add_lines(const Mesh& mesh, const Face& face, Vec3 normal, Part part);

    FlatArray<PackedQuadric> quadrics_;
};

}  // namespace regionmesh
