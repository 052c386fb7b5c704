// The components of regions of a surface that memory does not hold at once.
#pragma once

#include <vector>

#include "base/union_find.h"
#include "check/seam_sets.h"
#include "mesh/mesh_part.h"
#include "regionmesh/check.h"

namespace regionmesh {

/// Counts the connected parts of each region's boundary. Holds the faces that later parts have, too.
class PartComponents {
public:
    /// Adds to `regions`, which is by dense label, the components in a part, less those that turn out to be one with
    /// others. `sheets` has the sides 2 f + k of the faces, joined round the vertices of the part. Requires parts in
    /// the order of their numbers.
    void add(const Mesh& mesh, const MeshPart& part, UnionFind& sheets, std::vector<RegionReport>& regions);

private:
    SeamSets sets_;  // sets of sides of faces
};

/// The facts about a part that check_stars() needs.
struct PartStars {
    const MeshPart& part;
    PartComponents& components;
};

}  // namespace regionmesh
