// The faces of a model by interface, and the edges of its lines by label set.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compare/common_labels.h"
#include "mesh/mesh_part.h"
#include "regionmesh/ids.h"
#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Three points of a face; an edge repeats its second point: a face without area.
using Simplex = std::array<std::uint32_t, 3>;
inline bool is_edge(const Simplex& s) { return s[1] == s[2]; }

inline constexpr std::uint32_t kNoStratum = 0xFFFFFFFFu;

/// All faces, or edges, with one set of labels.
struct Stratum {
    std::vector<Label> labels;         // common labels, ascending; the exterior, exterior(0), stands last
    std::uint32_t begin = 0, end = 0;  // its simplices
    bool contains(Label label) const;
};

/// Simplices by stratum, each stratum along Hilbert's curve, and points in the order in which simplices use them: so
/// neighbours in space are neighbours in the arrays, whatever their order in the model.
struct SortedStrata {
    std::vector<Vec3> points;
    std::vector<Simplex> simplices;
    std::vector<double> ends;     // one per simplex: area or length of its stratum up to and including it
    std::vector<Stratum> strata;  // strata in order of labels
    Box bounds;                   // box of all vertices of the mesh

    /// Area or length of a stratum.
    double measure(const Stratum& stratum) const { return ends[stratum.end - 1]; }
};

/// A mesh of one of the two models, in common labels.
struct CommonView {
    const Mesh& mesh;
    const CommonLabels& labels;
    int which = 0;                   // model 0 or 1 of `labels`
    std::vector<Label> background;   // common; a simplex without other labels than these and the exterior is omitted
    const MeshPart* part = nullptr;  // part whose faces are taken, and edges by their first vertex; nullptr: all
};

/// Interfaces: two labels each.
SortedStrata interfaces_of(const CommonView& view, std::uint32_t threads);

/// Lines: edges with three labels or more. With `sides_apart` each side of the box counts as a label, and `labels` has
/// the exterior once per side: an edge of the box is a line. Otherwise the exterior counts once.
SortedStrata lines_of(const CommonView& view, bool sides_apart, std::uint32_t threads);

}  // namespace regionmesh
