// The steps of check(), in src/check/check.cpp, and of the check of a model in parts, in src/check/check_parts.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "check/findings.h"
#include "check/lines.h"
#include "mesh/label_set.h"
#include "mesh/mesh_part.h"
#include "mesh/sorted_face_tree.h"
#include "mesh/star_crossing.h"
#include "regionmesh/check.h"

namespace regionmesh {

struct PartStars;

/// Sums over all stars.
struct StarTotals {
    std::vector<RegionReport> regions;  // one per dense label
    std::uint64_t quadruple_points_inside = 0;
    LineTotals lines;
    std::vector<FacePair> crossings;  // crossing pairs of faces that share a vertex
};

/// Faces or vertices per task.
inline constexpr std::uint32_t kCheckChunk = 1 << 14;

/// Is the face ignored by its neighbours because it repeats a vertex?
inline bool repeats_a_vertex(const Face& face) {
    const auto& v = face.vertices;
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

/// Each step reads the mesh, or what belongs to a part of it, and adds its findings. `regions` is by dense label.
void check_faces(const Mesh& mesh, const CheckOptions& options, std::vector<RegionReport>& regions, CheckReport& report,
                 Findings& findings);
void check_stars(const Mesh& mesh, const CheckOptions& options, StarTotals& totals, Findings& findings,
                 const PartStars* part = nullptr);
void check_places(const Mesh& mesh, const CheckOptions& options, Findings& findings, const MeshPart* part = nullptr);
/// `in_stars` are the crossings of faces that share a vertex.
void check_crossing(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree& tree,
                    std::vector<FacePair> in_stars, Findings& findings, const MeshPart* part = nullptr);
/// `tree` may be null; the function then builds one if it needs it.
void check_nesting(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree* tree, Findings& findings);
/// Lists the regions that have faces, without the background.
void list_regions(const CheckOptions& options, const std::vector<RegionReport>& regions, CheckReport& report);
void check_against_labels(const CheckOptions& options, CheckReport& report, Findings& findings);
/// Finds regions that are inside out. `sums` are by dense label, the background included. If the surface is open
/// somewhere, or its orientation mixed, volumes mean nothing, and nothing is added.
void check_volumes(const CheckOptions& options, const std::vector<RegionReport>& sums, const CheckReport& report,
                   Findings& findings);

/// Adds the place and the labels of a violation, and appends the place to its sentence.
void place_violation(const Mesh& mesh, Violation& violation);
void place_violation(Vec3 at, const LabelSet& met, Violation& violation);

}  // namespace regionmesh
