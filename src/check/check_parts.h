// The check of a surface that memory does not hold at once, part by part.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "check/findings.h"
#include "check/lines.h"
#include "check/quality_sum.h"
#include "mesh/mesh_part.h"

namespace regionmesh {

/// Sums over the faces of all parts.
struct FaceTotals {
    QualitySum quality;
    std::vector<RegionReport> regions;        // by dense label
    std::unordered_set<std::uint64_t> pairs;  // of regions with an interface
};

/// Adds the faces of a part, or of the whole mesh. Volumes are measured from `origin`.
void sum_faces(const Mesh& mesh, const CheckOptions& options, const MeshPart* part, Vec3 origin, FaceTotals& totals,
               Findings& findings);

/// Checks parts one after the other, and their sums at the end. Finds all that check() finds but for what only the
/// connected whole says: `components` is 0, and nesting is not looked at. Ids in findings are those of the part, and
/// the sentences name it.
class PartsCheck {
public:
    /// Volumes are measured from `origin`: the middle of the box.
    PartsCheck(const CheckOptions& options, Vec3 origin) : options_(options), origin_(origin), all_(options.listed) {}

    /// Requires a mesh with all faces that touch a vertex or a face of the part, and vertices numbered in an order that
    /// is the same in all parts: an edge is counted at its first vertex.
    void add(const Mesh& mesh, const MeshPart& part);
    CheckReport finish();

private:
    const CheckOptions& options_;
    Vec3 origin_;
    Findings all_;
    FaceTotals faces_;
    LineTotals lines_;
    std::vector<RegionReport> stars_;
    CheckReport report_;
};

}  // namespace regionmesh
