#include <algorithm>

#include "base/exact_predicates.h"
#include "base/parallel_for.h"
#include "check/check_steps.h"
#include "check/crossing_faces.h"
#include "check/generic_star.h"
#include "regionmesh/check.h"

namespace regionmesh {
namespace {

void fix_corners(Mesh& mesh, FaceId f) {
    for (VertexId v : mesh[f].vertices) mesh[v].is_fixed = true;
}

void fix_stars(Mesh& mesh, const CheckOptions& options) {
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        GenericStar generic(mesh, options);
        std::vector<VertexId> found;
        for (std::uint32_t v = first; v < end; ++v)
            if (mesh.is_alive(VertexId{v}) && generic.fault(VertexId{v}) != StarFault::kNone)
                found.push_back(VertexId{v});
        return found;
    };
    std::vector<VertexId> all;
    for_chunks(mesh.vertex_end(), kCheckChunk, options.threads, find,
               [&](const std::vector<VertexId>& found) { all.insert(all.end(), found.begin(), found.end()); });
    for (VertexId v : all) mesh[v].is_fixed = true;
}

}  // namespace

LockedPart lock_violations(Mesh& mesh, const CheckOptions& options) {
    fix_stars(mesh, options);
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto p = mesh.corners(FaceId{f});
        if (is_degenerate({p[0], p[1], p[2]})) fix_corners(mesh, FaceId{f});
    }
    for (const auto& [f, g] : find_crossings(mesh, SortedFaceTree(mesh, options.threads), options.threads)) {
        fix_corners(mesh, f);
        fix_corners(mesh, g);
    }
    LockedPart fixed;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        fixed.vertices += mesh.is_alive(VertexId{v}) && mesh[VertexId{v}].is_fixed;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto& v = mesh[FaceId{f}].vertices;
        fixed.faces += std::all_of(v.begin(), v.end(), [&](VertexId n) { return mesh[n].is_fixed; });
    }
    return fixed;
}

}  // namespace regionmesh
