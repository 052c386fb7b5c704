// Single-resolution meshes: for each region a list of fragments, for each fragment its vertices and faces.
#include <fmt/format.h>

#include <map>
#include <string_view>

#include "blocks/precomputed/precomputed.h"
#include "mesh/edge_rounding.h"

namespace regionmesh {
namespace {

/// The part of a region's boundary in a piece, its faces outward.
struct Fragment {
    std::vector<float> positions;
    std::vector<std::uint32_t> corners;
};

std::map<Label, Fragment> fragments_of(const Mesh& mesh, const Precomputed& precomputed) {
    std::map<Label, Fragment> fragments;
    std::map<Label, std::map<VertexId, std::uint32_t>> numbers;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const Face& face = mesh[FaceId{f}];
        for (int side = 0; side < 2; ++side) {
            const Label label = face.labels[side];
            if (!precomputed.is_region(label)) continue;
            Fragment& fragment = fragments[label];
            for (int n = 0; n < 3; ++n) {
                const VertexId v = face.vertices[side == 0 ? n : 2 - n];
                const auto next = static_cast<std::uint32_t>(fragment.positions.size() / 3);
                const auto [place, is_new] = numbers[label].try_emplace(v, next);
                fragment.corners.push_back(place->second);
                if (!is_new) continue;
                for (int axis = 0; axis < 3; ++axis)
                    fragment.positions.push_back(static_cast<float>(mesh.position(v)[axis] * precomputed.nanometres()));
            }
        }
    }
    return fragments;
}

template <class T>
std::string_view bytes_of(const std::vector<T>& items) {
    return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

}  // namespace

WrittenRegions write_legacy_meshes(const Precomputed& precomputed, ModelLevels& model) {
    std::map<Label, Json> lists;
    WrittenRegions written;
    EdgeRounding rounding;
    std::uint32_t part = 0;
    model.visit(1, [&](std::uint32_t, const Mesh& mesh) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            written.box.add(mesh.position(VertexId{v}) * precomputed.nanometres());
        rounding.add(mesh);
        for (const auto& [label, fragment] : fragments_of(mesh, precomputed)) {
            const std::string name = fmt::format("{}:0:{}", precomputed.id(label), part);
            OutputFile file(precomputed.output / name, precomputed.options.output);
            const std::vector<std::uint32_t> count{static_cast<std::uint32_t>(fragment.positions.size() / 3)};
            file.write(bytes_of(count));
            file.write(bytes_of(fragment.positions));
            file.write(bytes_of(fragment.corners));
            precomputed.files.commit(file, name);
            lists[label].push_back(name);
            written.faces[label] += fragment.corners.size() / 3;
        }
        ++part;
    });
    for (const auto& [label, names] : lists)
        precomputed.write(precomputed.id(label) + ":0", text_of(Json{{"fragments", names}}));
    written.info = {{"@type", "neuroglancer_legacy_mesh"}};
    written.rounded_share_of_edge = rounding.share();
    return written;
}

}  // namespace regionmesh
