// Is the star of a vertex generic?
#pragma once

#include <array>
#include <vector>

#include "mesh/fan.h"
#include "mesh/label_set.h"
#include "mesh/star_edges.h"
#include "regionmesh/check.h"

namespace regionmesh {

/// The first fault of a star, in the order of the tests.
enum class StarFault {
    kNone,
    kLabels,  // more than four labels meet, or a face has one label on both sides, or there is no face
    kSize,    // it has too many faces to be examined
    kFans,    // the faces of a region are not one closed fan (or an open one, on a side of the box that is open)
    kPages,   // more than three labels meet at an edge
    kLines,   // the lines that leave the vertex are not those of a book (two) or of a cone over K4 (four)
};

/// A vertex is generic if its star is a disk (two labels), a book of three pages (three labels) or the cone over K4
/// (four labels); sides of the box count as labels. Simplification preserves the topology around generic vertices only.
/// Only reads the mesh. Use one object per thread.
class GenericStar {
public:
    GenericStar(const Mesh& mesh, const CheckOptions& options) : mesh_(mesh), options_(options) {}

    StarFault fault(VertexId v);
    /// The same for a star in which the faces of each region are known to be one closed fan, and each face to have two
    /// labels. `labels` of them meet, sides of the box included; `edges` are those at v, unused for fewer than three
    /// labels.
    StarFault fault_of_fans(VertexId v, int labels, const StarEdges& edges);

private:
    bool has_one_fan(VertexId v, Label label);
    bool may_be_open(Label label, VertexId v, VertexId end, FaceId face) const;
    StarFault look_at_lines(VertexId v, int labels, const StarEdges& edges);

    const Mesh& mesh_;
    const CheckOptions& options_;
    std::vector<FanPage> fan_;
    StarEdges edges_;
    std::vector<std::array<Label, 3>> triples_;
};

}  // namespace regionmesh
