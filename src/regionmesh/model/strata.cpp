#include "regionmesh/model/strata.h"

namespace regionmesh {
namespace {

void add_sides(LabelSet& set, SideSet sides) {
    for (int side = 0; side < kSideCount; ++side)
        if (sides >> side & 1) set.add(exterior(side));
}

}  // namespace

LabelSet vertex_labels(const Model& model, VertexId v) {
    LabelSet set;
    add_sides(set, model[v].sides);
    model.for_star(v, [&](FaceId f, int) {
        for (Label label : model[f].labels) set.add(label);
    });
    return set;
}

LabelSet edge_labels(const Model& model, VertexId u, VertexId v) {
    LabelSet set;
    int uses = 0;
    model.for_star(u, [&](FaceId f, int place) {
        const Face& face = model[f];
        if (face.vertices[(place + 1) % 3] != v && face.vertices[(place + 2) % 3] != v) return;
        for (Label label : face.labels) set.add(label);
        uses += 2;
    });
    // Round an edge in the inside of the surface every label has two faces.
    if (uses < 2 * set.size()) add_sides(set, model[u].sides & model[v].sides);
    return set;
}

void count_labels(Model& model) {
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) {
        Vertex& vertex = model[VertexId{v}];
        if (!vertex.is_alive || vertex.star == kNoCorner) continue;
        const auto& first = model[FaceId{vertex.star >> 2}].labels;
        bool is_interface = vertex.sides == 0 && first[0] != first[1];  // as most vertices are
        for (Corner c = vertex.star; c != kNoCorner && is_interface; c = model[FaceId{c >> 2}].next[c & 3])
            is_interface = model[FaceId{c >> 2}].labels == first;
        vertex.label_count = is_interface ? 2 : static_cast<std::uint8_t>(vertex_labels(model, VertexId{v}).size());
    }
}

}  // namespace regionmesh
