// Is the surface round a vertex what it is round every vertex of a generic model?
#pragma once

#include <vector>

#include "mesh/fan.h"
#include "mesh/label_set.h"
#include "regionmesh/check.h"

namespace regionmesh {

/// The first thing that is wrong with a star, in the order of the tests.
enum class StarFault {
    kNone,
    kLabels,  // more than four labels meet, or a face has one label on both sides, or there is no face
    kFans,    // the faces of a region are not one closed fan; at a side of the box it may be open where the options say
    kPages,   // more than three labels meet at an edge
    kLines,   // the lines that leave the vertex are not those of a book (two) or of a cone over K4 (four)
};

/// Tells generic vertices from others: two labels and a disk, three and a book of three pages, four and the cone over
/// K4, where sides of the box count as labels. Decimation keeps the topology round such vertices, and only such.
/// Reads the model; one for each thread.
class GenericStar {
public:
    GenericStar(const Mesh& mesh, const CheckOptions& options) : mesh_(mesh), options_(options) {}

    StarFault fault(VertexId v);

private:
    bool has_one_fan(VertexId v, Label label);
    bool may_be_open(Label label, VertexId v, VertexId end) const;
    StarFault look_at_lines(VertexId v, const LabelSet& labels);

    const Mesh& mesh_;
    const CheckOptions& options_;
    std::vector<FanPage> fan_;
    std::vector<VertexId> neighbours_;
    std::vector<std::vector<Label>> triples_;
};

}  // namespace regionmesh
