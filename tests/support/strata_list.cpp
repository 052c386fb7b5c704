#include "support/strata_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "base/union_find.h"
#include "mesh/strata.h"

namespace regionmesh::test {
namespace {

std::vector<Label> sorted(const LabelSet& set) {
    std::vector<Label> labels(set.begin(), set.end());
    std::ranges::sort(labels);
    return labels;
}

std::string text_of(const std::vector<Label>& labels) {
    std::string text;
    for (Label label : labels)
        text += is_exterior(label) ? "side " + std::to_string(side_of(label)) + ", " : std::to_string(label) + ", ";
    return text.substr(0, text.size() - 2);
}

using Edge = std::pair<VertexId, VertexId>;

Edge edge_of(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Vertices, edges and faces as numbers in one row, each with its label set.
class Simplices {
public:
    explicit Simplices(const Mesh& mesh) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
            const bool is_alive = mesh.is_alive(VertexId{v});
            add(is_alive ? sorted(vertex_labels(mesh, VertexId{v})) : std::vector<Label>{}, 0);
        }
        for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
            if (mesh.is_alive(FaceId{f})) add_face(mesh, FaceId{f});
    }

    StrataList strata() const {
        UnionFind joined(static_cast<std::uint32_t>(labels_.size()));
        for (const auto& [low, high] : incidences_)
            if (labels_[low] == labels_[high]) joined.join(low, high);
        StrataList list;
        for (std::uint32_t n = 0; n < labels_.size(); ++n) {
            if (labels_[n].empty()) continue;
            Stratum& stratum = list[labels_[n]];
            stratum.euler += dimension_[n] == 1 ? -1 : 1;
            stratum.components += joined.find(n) == n;
        }
        return list;
    }

private:
    std::uint32_t add(std::vector<Label> labels, int dimension) {
        labels_.push_back(std::move(labels));
        dimension_.push_back(dimension);
        return static_cast<std::uint32_t>(labels_.size()) - 1;
    }

    void add_face(const Mesh& mesh, FaceId f) {
        const auto& v = mesh[f].vertices;
        const std::uint32_t face = add({mesh[f].labels[0], mesh[f].labels[1]}, 2);
        for (int n = 0; n < 3; ++n) {
            const Edge edge = edge_of(v[n], v[(n + 1) % 3]);
            auto at = edges_.find(edge);
            if (at == edges_.end()) {
                at = edges_.emplace(edge, add(sorted(edge_labels(mesh, edge.first, edge.second)), 1)).first;
                incidences_.push_back({index(edge.first), at->second});
                incidences_.push_back({index(edge.second), at->second});
            }
            incidences_.push_back({at->second, face});
        }
    }

    std::vector<std::vector<Label>> labels_;
    std::vector<int> dimension_;
    std::map<Edge, std::uint32_t> edges_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> incidences_;
};

int lines_at(const Mesh& mesh, VertexId v) {
    std::vector<VertexId> neighbours;
    mesh.for_star(v, [&](FaceId f, int place) {
        for (int n = 1; n < 3; ++n) neighbours.push_back(mesh[f].vertices[(place + n) % 3]);
    });
    std::ranges::sort(neighbours);
    const auto rest = std::ranges::unique(neighbours);
    return static_cast<int>(std::count_if(neighbours.begin(), rest.begin(),
                                          [&](VertexId w) { return edge_labels(mesh, v, w).size() > 2; }));
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Stratum& stratum) {
    return out << stratum.components << " components with Euler characteristic " << stratum.euler;
}

StrataList list_strata(const Mesh& mesh) { return Simplices(mesh).strata(); }

void expect_same_strata(const StrataList& found, const StrataList& expected) {
    for (const StrataList* list : {&found, &expected})
        for (const auto& [labels, stratum] : *list) {
            if (list == &expected && found.contains(labels)) continue;
            const auto at = [&](const StrataList& in) { return in.contains(labels) ? in.at(labels) : Stratum{}; };
            EXPECT_EQ(at(found), at(expected)) << "where these meet: " << text_of(labels);
        }
}

void expect_generic(const Mesh& mesh) {
    for (std::uint32_t n = 0; n < mesh.vertex_end(); ++n) {
        const VertexId v{n};
        if (!mesh.is_alive(v)) continue;
        const LabelSet labels = vertex_labels(mesh, v);
        ASSERT_TRUE(labels.size() >= 2 && labels.size() <= 4)
            << "vertex " << n << " has " << labels.size() << " labels";
        const bool is_corner_of_box = std::ranges::count_if(labels, is_exterior) == 3;
        ASSERT_EQ(lines_at(mesh, v), is_corner_of_box     ? 3
                                     : labels.size() == 2 ? 0
                                     : labels.size() == 3 ? 2
                                                          : 4)
            << "at vertex " << n;
    }
}

}  // namespace regionmesh::test
