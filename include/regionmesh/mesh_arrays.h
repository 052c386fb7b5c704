// A mesh as plain arrays, out and in: for programs that use no file format.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// n points and m faces, with the conventions of .vtp files (docs/reference/files.md).
struct MeshArrays {
    std::vector<Vec3> points = {};                         // (n, 3) double
    std::vector<std::array<std::uint32_t, 3>> faces = {};  // (m, 3) rows of `points`; the normal of a face points from
                                                           // its first label to its second
    std::vector<std::array<InputLabel, 2>> labels = {};    // (m, 2) exported: smaller label first, background and
                                                           // exterior second
    std::vector<std::uint8_t> node_types = {};             // (n) labels around the point, sides of the box included:
                                                           // 2, 3, 4; +10 on the box. Import: may be empty
    InputLabel exterior_label = -1;                        // stands for the exterior in `labels`
    bool is_unsigned = false;                              // labels are unsigned 64-bit numbers
};
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// The living vertices and faces, in order of id. `background`: labels that are second in a pair, like the exterior.
/// Throws Error(kInput) for a table that lacks a label of the mesh.
MeshArrays export_arrays(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background = {});

struct LabelledMesh {
    Mesh mesh;
    LabelTable labels;
};

/// Vertex and face ids are the rows of the arrays. A face with the exterior label lies on a side of the box if all such
/// faces lie exactly in planes of the bounding box of all faces, and no more than four labels, sides included, meet on
/// its edges and corners; vertices then get the sides of their exterior faces. The same holds for an oblique box, to a
/// millionth of its size (regionmesh/box_axes.h). Otherwise the exterior is one: side 0, or kHull if node_types say
/// which points lie on the hull, or a label ends there that has no face with the exterior.
/// Throws Error(kInput) for arrays of different length, a face that names no point, a point that is not finite, or
/// sizes beyond the limits (limits.h).
LabelledMesh import_arrays(const MeshArrays& arrays);

}  // namespace regionmesh
