#include "regionmesh/check/fix_unsound.h"

#include <algorithm>

#include "regionmesh/base/exact_predicates.h"
#include "regionmesh/base/parallel_for.h"
#include "regionmesh/check/findings.h"
#include "regionmesh/check/generic_star.h"
#include "regionmesh/model/crossing.h"

namespace regionmesh {
namespace {

void fix_corners(Model& model, FaceId f) {
    for (VertexId v : model[f].vertices) model[v].is_fixed = true;
}

void fix_stars(Model& model, const CheckOptions& options) {
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        GenericStar generic(model, options);
        std::vector<VertexId> found;
        for (std::uint32_t v = first; v < end; ++v)
            if (model.is_alive(VertexId{v}) && generic.fault(VertexId{v}) != StarFault::kNone)
                found.push_back(VertexId{v});
        return found;
    };
    std::vector<VertexId> all;
    for_chunks(model.vertex_end(), kCheckChunk, options.threads, find,
               [&](const std::vector<VertexId>& found) { all.insert(all.end(), found.begin(), found.end()); });
    for (VertexId v : all) model[v].is_fixed = true;
}

}  // namespace

FixedPart fix_unsound(Model& model, const CheckOptions& options) {
    fix_stars(model, options);
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const auto p = model.corners(FaceId{f});
        if (is_degenerate({p[0], p[1], p[2]})) fix_corners(model, FaceId{f});
    }
    for (const auto& [f, g] : find_crossings(model, SortedFaceTree(model, options.threads), options.threads)) {
        fix_corners(model, f);
        fix_corners(model, g);
    }
    FixedPart fixed;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v)
        fixed.vertices += model.is_alive(VertexId{v}) && model[VertexId{v}].is_fixed;
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const auto& v = model[FaceId{f}].vertices;
        fixed.faces += std::all_of(v.begin(), v.end(), [&](VertexId n) { return model[n].is_fixed; });
    }
    return fixed;
}

}  // namespace regionmesh
