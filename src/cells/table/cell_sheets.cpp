#include "cells/table/cell_sheets.h"

#include <map>
#include <set>
#include <utility>

#include "cells/marching_tetrahedra.h"

namespace regionmesh::cell_table {
namespace {

using Edge = std::pair<NodeSet, NodeSet>;

Edge edge_between(NodeSet a, NodeSet b) { return a < b ? Edge{a, b} : Edge{b, a}; }

template <class Visit>
void for_each_edge(const CellFace& face, Visit&& visit) {
    for (int n = 0; n < 3; ++n) visit(face.vertices[n], face.vertices[(n + 1) % 3]);
}

/// The number of the sheet of each face.
std::vector<int> number_sheets(const std::vector<CellFace>& faces, int& count) {
    std::map<Edge, std::vector<std::size_t>> around;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for_each_edge(faces[f], [&](NodeSet a, NodeSet b) { around[edge_between(a, b)].push_back(f); });
    std::vector<int> sheet(faces.size(), -1);
    count = 0;
    for (std::size_t first = 0; first < faces.size(); ++first) {
        if (sheet[first] >= 0) continue;
        std::vector<std::size_t> open{first};
        sheet[first] = count;
        while (!open.empty()) {
            const CellFace& face = faces[open.back()];
            open.pop_back();
            for_each_edge(face, [&](NodeSet a, NodeSet b) {
                const auto& both = around[edge_between(a, b)];
                if (both.size() != 2) return;  // a line, or on a side of the cell
                for (std::size_t next : both)
                    if (sheet[next] < 0 && faces[next].first == face.first && faces[next].second == face.second) {
                        sheet[next] = count;
                        open.push_back(next);
                    }
            });
        }
        ++count;
    }
    return sheet;
}

Sheet make_sheet(const std::vector<CellFace>& faces) {
    Sheet sheet{faces[0].first, faces[0].second, {}, 0, false};
    std::set<NodeSet> vertices;
    std::map<Edge, int> edges;
    for (const CellFace& face : faces) {
        vertices.insert(face.vertices.begin(), face.vertices.end());
        for_each_edge(face, [&](NodeSet a, NodeSet b) { ++edges[edge_between(a, b)]; });
    }
    std::map<NodeSet, NodeSet> next;
    for (const CellFace& face : faces)
        for_each_edge(face, [&](NodeSet a, NodeSet b) {
            if (edges[edge_between(a, b)] == 1) next[a] = b;
        });
    while (!next.empty()) {
        Loop& loop = sheet.boundary.emplace_back();
        for (auto at = next.begin(); at != next.end();) {
            const auto [vertex, to] = *at;
            loop.push_back(vertex);
            next.erase(at);
            at = next.find(to);
        }
    }
    sheet.euler = static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.size());
    sheet.has_main_diagonal = vertices.count(kMainDiagonal) > 0;
    return sheet;
}

}  // namespace

std::vector<CellFace> tetrahedra_faces(const Partition& labels) {
    std::vector<CellFace> faces;
    for (int kind = kFirstTetrahedron; kind < kKindCount; ++kind) {
        const std::array<Step, 4>& corner = kKinds[kind].steps;
        const TetrahedronCases cases = make_tetrahedron_cases(corner, QuadCuts::kCones);
        const unsigned pattern =
            tetrahedron_pattern(labels[corner[0]], labels[corner[1]], labels[corner[2]], labels[corner[3]]);
        for (const CaseFace& made : cases[pattern]) {
            CellFace face{{}, labels[corner[made.first]], labels[corner[made.second]]};
            for (int n = 0; n < 3; ++n)
                for (int c = 0; c < 4; ++c)
                    if (made.vertices[n] >> c & 1) face.vertices[n] |= static_cast<NodeSet>(1 << corner[c]);
            if (face.first > face.second) {
                std::swap(face.first, face.second);
                std::swap(face.vertices[1], face.vertices[2]);
            }
            faces.push_back(face);
        }
    }
    return faces;
}

std::vector<Sheet> sheets_of(const std::vector<CellFace>& faces) {
    int count = 0;
    const std::vector<int> number = number_sheets(faces, count);
    std::vector<std::vector<CellFace>> parted(static_cast<std::size_t>(count));
    for (std::size_t f = 0; f < faces.size(); ++f) parted[static_cast<std::size_t>(number[f])].push_back(faces[f]);
    std::vector<Sheet> sheets;
    for (const auto& own : parted) sheets.push_back(make_sheet(own));
    return sheets;
}

}  // namespace regionmesh::cell_table
