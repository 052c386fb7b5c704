// Faces that meet outside shared vertices and edges, exactly (P test 6, for the whole mesh).
#include <algorithm>

#include "check/check_steps.h"
#include "check/crossing_faces.h"

namespace regionmesh {

void check_crossing(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree& tree,
                    std::vector<FacePair> in_stars, Findings& findings, const MeshPart* part) {
    std::vector<FacePair> all = std::move(in_stars);
    for (const FacePair pair : find_crossings_apart(mesh, tree, options.threads))
        if (!part || part->has(pair.f, pair.g)) all.push_back(pair);
    std::sort(all.begin(), all.end());
    for (const auto& [f, g] : all) {
        findings.add(ViolationKind::kCrossingFaces, {}, {index(f), index(g)}, [f = f, g = g] {
            return "faces " + std::to_string(index(f)) + " and " + std::to_string(index(g)) + " cross";
        });
    }
}

}  // namespace regionmesh
