#include "mesh/strata.h"

namespace regionmesh {
namespace {

void add_sides(LabelSet& set, SideSet sides) {
    for (int side = 0; side < kSideCount; ++side)
        if (sides >> side & 1) set.add(exterior(side));
}

}  // namespace

LabelSet vertex_labels(const Mesh& mesh, VertexId v) {
    LabelSet set;
    add_sides(set, mesh[v].sides);
    mesh.for_star(v, [&](FaceId f, int) {
        for (Label label : mesh[f].labels) set.add(label);
    });
    return set;
}

LabelSet edge_labels(const Mesh& mesh, VertexId u, VertexId v) {
    LabelSet set;
    int uses = 0;
    mesh.for_star(u, [&](FaceId f, int place) {
        const Face& face = mesh[f];
        if (face.vertices[place_after(place)] != v && face.vertices[place_before(place)] != v) return;
        for (Label label : face.labels) set.add(label);
        uses += 2;
    });
    // Around an interior edge every label has two faces.
    if (uses < 2 * set.size()) add_sides(set, mesh[u].sides & mesh[v].sides);
    return set;
}

void count_labels(Mesh& mesh) {
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        Vertex& vertex = mesh[VertexId{v}];
        if (!vertex.is_alive || vertex.star == kNoCorner) continue;
        const auto& first = mesh[FaceId{vertex.star >> 2}].labels;
        bool is_interface = vertex.sides == 0 && first[0] != first[1];  // true for most vertices
        for (Corner c = vertex.star; c != kNoCorner && is_interface; c = mesh[FaceId{c >> 2}].next[c & 3])
            is_interface = mesh[FaceId{c >> 2}].has_labels(first);
        vertex.label_count = is_interface ? 2 : static_cast<std::uint8_t>(vertex_labels(mesh, VertexId{v}).size() & 31);
    }
}

}  // namespace regionmesh
