#include "regionmesh/check/lines.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "regionmesh/model/strata.h"

namespace regionmesh {
namespace {

bool is_inside(const LabelSet& labels) { return std::none_of(labels.begin(), labels.end(), is_exterior); }

/// Ends of the line edges at v other than v.
void gather_line_neighbours(const Model& model, VertexId v, std::vector<VertexId>& found) {
    found.clear();
    model.for_star(v, [&](FaceId f, int place) {
        for (int step = 1; step < 3; ++step) {
            const VertexId w = model[f].vertices[(place + step) % 3];
            if (std::find(found.begin(), found.end(), w) == found.end()) found.push_back(w);
        }
    });
    std::erase_if(found, [&](VertexId w) {
        const LabelSet labels = edge_labels(model, v, w);
        return labels.size() < 3 || !is_inside(labels);
    });
}

}  // namespace

LineReport measure_lines(const Model& model) {
    LineReport report;
    std::vector<VertexId> ends;
    double turned = 0;
    std::uint64_t turns = 0;
    for (std::uint32_t n = 0; n < model.vertex_end(); ++n) {
        const VertexId v{n};
        if (!model.is_alive(v) || vertex_labels(model, v).size() < 3) continue;
        gather_line_neighbours(model, v, ends);
        const Vec3 p = model.position(v);
        for (VertexId w : ends) {
            if (w < v) continue;
            ++report.edges;
            report.length += length(model.position(w) - p);
        }
        if (ends.size() != 2) continue;
        const Vec3 in = p - model.position(ends[0]), out = model.position(ends[1]) - p;
        turned += std::atan2(length(cross(in, out)), dot(in, out));
        ++turns;
    }
    if (turns > 0) report.mean_turning_angle = turned / static_cast<double>(turns) * 180 / std::numbers::pi;
    return report;
}

}  // namespace regionmesh
