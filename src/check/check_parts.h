// The check of a surface that memory does not hold at once, part by part.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "check/check_steps.h"
#include "check/part_components.h"
#include "check/part_nesting.h"
#include "check/quality_sum.h"
#include "mesh/mesh_part.h"

namespace regionmesh {

/// Sums over the faces of all parts.
struct FaceTotals {
    QualitySum quality;
    std::vector<RegionReport> regions;        // one per dense label
    std::unordered_set<std::uint64_t> pairs;  // pairs of regions with an interface
};

/// Adds the faces of a part, or of the whole mesh. Volumes are measured from `origin`.
void sum_faces(const Mesh& mesh, const CheckOptions& options, const MeshPart* part, Vec3 origin, FaceTotals& totals,
               Findings& findings);

/// Checks parts one after the other, and their sums at the end. Finds all that check() finds. Ids in findings are those
/// of the part, and the sentences name it.
class PartsCheck {
public:
    /// Volumes are measured from `origin`: the middle of the box.
    PartsCheck(const CheckOptions& options, Vec3 origin)
        : options_(options), origin_(origin), all_(options.listed), nesting_(origin) {}

    /// Requires a mesh with all faces that touch a vertex or a face of the part, and vertices numbered in an order that
    /// is the same in all parts: an edge is counted at its first vertex. Parts come in the order of their numbers.
    void add(const Mesh& mesh, const MeshPart& part);
    /// Second pass, before finish(): each face in a box that needs() takes has to come in a mesh.
    void begin_rays(double reach) { nesting_.begin_rays(reach); }
    bool needs(const Box& box) const { return nesting_.needs(box); }
    void add_rays(const Mesh& mesh) { nesting_.meet(mesh, options_.threads); }
    CheckReport finish();

private:
    const CheckOptions& options_;
    Vec3 origin_;
    Findings all_;
    FaceTotals faces_;
    StarTotals stars_;
    PartComponents components_;
    PartNesting nesting_;
    CheckReport report_;
};

}  // namespace regionmesh
