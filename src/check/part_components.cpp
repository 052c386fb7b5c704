#include "check/part_components.h"

#include <unordered_map>

namespace regionmesh {

void PartComponents::add(const Mesh& mesh, const MeshPart& part, UnionFind& sheets,
                         std::vector<RegionReport>& regions) {
    std::unordered_map<std::uint32_t, std::uint32_t> set_of;  // key: root
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const Face& face = mesh[FaceId{f}];
        const MeshPart::Span parts = part.span_of(face.vertices);
        if (!parts.has_own) continue;  // joined in other parts
        for (std::uint32_t side = 0; side < 2; ++side) {
            const Label label = face.labels[side];
            if (is_exterior(label)) continue;
            if (label >= regions.size()) regions.resize(label + 1);
            const std::uint32_t sheet = 2 * f + side, root = sheets.find(sheet);
            if (root == sheet) ++regions[label].components;
            if (parts.first == parts.last) continue;
            const auto [at, is_new] = set_of.try_emplace(root);
            if (is_new) at->second = sets_.add();
            const auto [kept, gone] = sets_.meet(2 * part.key_of_face[f] + side, at->second, parts.last == part.number);
            if (kept != gone) --regions[label].components;
        }
    }
}

}  // namespace regionmesh
