#include "check/lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace regionmesh {
namespace {

bool is_inside(const LabelSet& labels) { return std::none_of(labels.begin(), labels.end(), is_exterior); }

}  // namespace

void LineTotals::add(const Mesh& mesh, VertexId v, const StarEdges& edges) {
    const Vec3 p = mesh.position(v);
    std::array<Vec3, 2> along;  // the first two line edges
    std::size_t lines = 0;
    for (std::size_t n = 0; n < edges.ends().size(); ++n) {
        const LabelSet& labels = edges.labels()[n];
        if (labels.size() < 3 || !is_inside(labels)) continue;
        const VertexId w = edges.ends()[n];
        const Vec3 edge = mesh.position(w) - p;
        if (lines < 2) along[lines] = edge;
        ++lines;
        if (w < v) continue;
        ++edges_;
        length_ += length(edge);
    }
    if (lines != 2) return;
    turned_ += std::atan2(length(cross(-along[0], along[1])), dot(-along[0], along[1]));
    ++turns_;
}

void LineTotals::append(const LineTotals& later) {
    edges_ += later.edges_;
    turns_ += later.turns_;
    length_ += later.length_;
    turned_ += later.turned_;
}

LineReport LineTotals::report() const {
    LineReport report{.edges = edges_, .length = length_};
    if (turns_ > 0) report.mean_turning_angle = turned_ / static_cast<double>(turns_) * 180 / std::numbers::pi;
    return report;
}

}  // namespace regionmesh
