#include "cells/table/polygon_cuts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/triangle.h"
#include "regionmesh/vec3.h"

namespace regionmesh::cell_table {
namespace {

Vec3 centroid_of(NodeSet simplex) {
    Vec3 sum;
    for (int n = 0; n < 8; ++n)
        if (simplex >> n & 1) sum += Vec3{double(n & 1), double(n >> 1 & 1), double(n >> 2 & 1)};
    return sum / std::popcount(static_cast<unsigned>(simplex));
}

/// Cuts polygons by choosing the triangle over the edge from the last vertex to the first, then both remaining parts.
class PolygonCutter {
public:
    PolygonCutter(const IsChord& is_chord, AnyPosition& positions) : is_chord_(is_chord), positions_(positions) {}

    void cut(const Loop& polygon) {
        open_ = {polygon};
        next();
    }
    /// Different cuts, the same triangles in any order once.
    std::map<std::set<Triangle>, Cut> found;

private:
    void next() {
        if (open_.empty()) return keep();
        const Loop polygon = std::move(open_.back());
        open_.pop_back();
        if (polygon.size() < 3) {
            next();
        } else {
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) choose(polygon, k);
        }
        open_.push_back(polygon);
    }

    void choose(const Loop& polygon, std::size_t k) {
        const NodeSet a = polygon.back(), b = polygon.front(), c = polygon[k];
        if (a == b || b == c || a == c) return;
        if ((k > 1 && !is_chord_(b, c)) || (k + 2 < polygon.size() && !is_chord_(c, a))) return;
        const Triangle made{a, b, c};
        for (const Triangle& other : cut_)
            if (!positions_.are_apart(made, other)) return;
        cut_.push_back(made);
        open_.emplace_back(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        open_.emplace_back(polygon.begin() + static_cast<std::ptrdiff_t>(k), polygon.end());
        next();
        open_.resize(open_.size() - 2);
        cut_.pop_back();
    }

    /// Two parts of the polygon may meet in an edge that has two triangles already.
    void keep() {
        std::map<std::pair<NodeSet, NodeSet>, int> uses;
        std::set<Triangle> key;
        for (Triangle triangle : cut_) {
            for (int n = 0; n < 3; ++n)
                if (++uses[std::minmax(triangle[n], triangle[(n + 1) % 3])] > 2) return;
            std::sort(triangle.begin(), triangle.end());
            if (!key.insert(triangle).second) return;
        }
        found.try_emplace(std::move(key), cut_);
    }

    const IsChord& is_chord_;
    AnyPosition& positions_;
    std::vector<Loop> open_;
    Cut cut_;
};

/// An annulus cut open from vertex i of one loop to vertex j of the other.
Loop opened(const Loop& one, std::size_t i, const Loop& other, std::size_t j) {
    Loop polygon;
    for (std::size_t k = 0; k <= one.size(); ++k) polygon.push_back(one[(i + k) % one.size()]);
    for (std::size_t k = 0; k <= other.size(); ++k) polygon.push_back(other[(j + k) % other.size()]);
    return polygon;
}

}  // namespace

double quality_of(const Cut& cut) {
    double worst = HUGE_VAL;
    for (const Triangle& t : cut)
        worst = std::min(worst, face_quality(centroid_of(t[0]), centroid_of(t[1]), centroid_of(t[2])));
    return worst;
}

std::vector<Cut> cuts_of(const std::vector<Loop>& boundary, const IsChord& is_chord, AnyPosition& positions) {
    PolygonCutter cutter(is_chord, positions);
    if (boundary.size() == 1) {
        cutter.cut(boundary[0]);
    } else {
        const Loop &one = boundary[0], &other = boundary[1];
        for (std::size_t i = 0; i < one.size(); ++i)
            for (std::size_t j = 0; j < other.size(); ++j)
                if (is_chord(one[i], other[j])) cutter.cut(opened(one, i, other, j));
    }
    std::vector<Cut> cuts;
    for (auto& [key, cut] : cutter.found) cuts.push_back(std::move(cut));
    std::stable_sort(cuts.begin(), cuts.end(),
                     [](const Cut& a, const Cut& b) { return quality_of(a) > quality_of(b); });
    return cuts;
}

}  // namespace regionmesh::cell_table
