#include "mesh/strata.h"

#include <algorithm>

#include "base/parallel_for.h"

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
    // The faces of the edge are written without branches, which would be mispredicted; more than kMost at a time do not
    // occur in surfaces without violations.
    constexpr int kMost = LabelSet::kCapacity;
    std::array<FaceId, kMost + 1> faces;
    LabelSet set;
    int count = 0, uses = 0;
    const auto add = [&] {
        for (int n = 0; n < count; ++n)
            for (Label label : mesh[faces[n]].labels) set.add(label);
        uses += 2 * count;
        count = 0;
    };
    mesh.for_star(u, [&](FaceId f, int place) {
        const auto& corners = mesh[f].vertices;
        faces[count] = f;
        count += (corners[place_after(place)] == v) | (corners[place_before(place)] == v);
        if (count == kMost) add();
    });
    add();
    // Around an interior edge every label has two faces.
    if (uses < 2 * set.size()) add_sides(set, mesh[u].sides & mesh[v].sides);
    return set;
}

void count_labels(Mesh& mesh, std::uint32_t threads) {
    constexpr std::uint32_t kVertices = 4096;  // vertices of a task
    for_each_index(mesh.vertex_end(), kVertices, threads, [&](std::uint32_t v) {
        Vertex& vertex = mesh[VertexId{v}];
        if (!vertex.is_alive || vertex.star == kNoCorner) return;
        const auto& first = mesh[FaceId{vertex.star >> 2}].labels;
        bool is_interface = vertex.sides == 0 && first[0] != first[1];  // true for most vertices
        for (Corner c = vertex.star; c != kNoCorner && is_interface; c = mesh[FaceId{c >> 2}].next[c & 3])
            is_interface = mesh[FaceId{c >> 2}].has_labels(first);
        const int count = is_interface ? 2 : vertex_labels(mesh, VertexId{v}).size();
        vertex.label_count = static_cast<std::uint8_t>(count & 31);
    });
}

}  // namespace regionmesh
