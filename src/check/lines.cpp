#include "check/lines.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "base/parallel_for.h"
#include "check/findings.h"
#include "mesh/star_edges.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

bool is_inside(const LabelSet& labels) { return std::none_of(labels.begin(), labels.end(), is_exterior); }

/// Vertices of three labels or more, in the order of their ids.
std::vector<VertexId> find_line_vertices(const Mesh& mesh, const MeshPart* part, std::uint32_t threads) {
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        std::vector<VertexId> found;
        for (std::uint32_t n = first; n < end; ++n) {
            const VertexId v{n};
            if (!mesh.is_alive(v) || (part && !part->has(v)) || vertex_labels(mesh, v).size() < 3) continue;
            found.push_back(v);
        }
        return found;
    };
    std::vector<VertexId> all;
    for_chunks(mesh.vertex_end(), kCheckChunk, threads, find,
               [&](const std::vector<VertexId>& found) { all.insert(all.end(), found.begin(), found.end()); });
    return all;
}

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

LineTotals sum_lines(const Mesh& mesh, const MeshPart* part, std::uint32_t threads) {
    LineTotals totals;
    StarEdges edges;
    std::vector<VertexId> ends;
    for (const VertexId v : find_line_vertices(mesh, part, threads)) {
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

LineReport measure_lines(const Mesh& mesh, std::uint32_t threads) { return sum_lines(mesh, nullptr, threads).report(); }

}  // namespace regionmesh
