#include "check/lines.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "mesh/star_edges.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

bool is_inside(const LabelSet& labels) { return std::none_of(labels.begin(), labels.end(), is_exterior); }

/// The other ends of the line edges at v.
void gather_line_neighbours(const Mesh& mesh, VertexId v, StarEdges& edges, std::vector<VertexId>& found) {
    edges.gather(mesh, v);
    found.clear();
    for (std::size_t n = 0; n < edges.ends().size(); ++n) {
        const LabelSet& labels = edges.labels()[n];
        if (labels.size() >= 3 && is_inside(labels)) found.push_back(edges.ends()[n]);
    }
}

}  // namespace

LineReport LineTotals::report() const {
    LineReport report{.edges = edges, .length = length};
    if (turns > 0) report.mean_turning_angle = turned / static_cast<double>(turns) * 180 / std::numbers::pi;
    return report;
}

LineTotals sum_lines(const Mesh& mesh, const MeshPart* part) {
    LineTotals totals;
    StarEdges edges;
    std::vector<VertexId> ends;
    for (std::uint32_t n = 0; n < mesh.vertex_end(); ++n) {
        const VertexId v{n};
        if (!mesh.is_alive(v) || (part && !part->has(v)) || vertex_labels(mesh, v).size() < 3) continue;
        gather_line_neighbours(mesh, v, edges, ends);
        const Vec3 p = mesh.position(v);
        for (VertexId w : ends) {
            if (w < v) continue;
            ++totals.edges;
            totals.length += length(mesh.position(w) - p);
        }
        if (ends.size() != 2) continue;
        const Vec3 in = p - mesh.position(ends[0]), out = mesh.position(ends[1]) - p;
        totals.turned += std::atan2(length(cross(in, out)), dot(in, out));
        ++totals.turns;
    }
    return totals;
}

LineReport measure_lines(const Mesh& mesh) { return sum_lines(mesh, nullptr).report(); }

}  // namespace regionmesh
