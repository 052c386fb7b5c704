// Faces that meet outside shared vertices and edges, exactly (P test 6, for the whole mesh).
#include "mesh/crossing.h"

#include "check/findings.h"

namespace regionmesh {

void check_crossing(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree& tree, Findings& findings,
                    const MeshPart* part) {
    for (const auto& [f, g] : find_crossings(mesh, tree, options.threads)) {
        if (part && !part->has(f, g)) continue;
        findings.add(ViolationKind::kCrossingFaces, {}, {index(f), index(g)}, [f = f, g = g] {
            return "faces " + std::to_string(index(f)) + " and " + std::to_string(index(g)) + " cross";
        });
    }
}

}  // namespace regionmesh
