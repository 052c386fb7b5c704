#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel_for.h"
#include "regionmesh/shapes.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 1 << 13;

/// Round one vertex. Holds scratch space.
class StarShapes {
public:
    StarShapes(const Mesh& mesh, double unit) : mesh_(mesh) {
        report_.unit = unit;
        report_.shortest_edge = HUGE_VAL;
        report_.least_dihedral = 360;
    }

    void add(VertexId v) {
        pages_.clear();
        mesh_.for_star(v, [&](FaceId f, int place) {
            const auto& corners = mesh_[f].vertices;
            const VertexId after = corners[place_after(place)], before = corners[place_before(place)];
            pages_.push_back({after, before});
            pages_.push_back({before, after});
        });
        if (pages_.empty()) return;
        std::ranges::sort(pages_, {}, [](const Page& page) { return page.end; });
        const Vec3 at = mesh_.position(v);
        double shortest = HUGE_VAL, longest = 0;
        std::uint32_t valence = 0;
        for (std::size_t first = 0, last; first < pages_.size(); first = last) {
            for (last = first + 1; last < pages_.size() && pages_[last].end == pages_[first].end;) ++last;
            const VertexId end = pages_[first].end;
            const double size = length(mesh_.position(end) - at);
            shortest = std::min(shortest, size);
            longest = std::max(longest, size);
            ++valence;
            if (v < end) add_edge(at, mesh_.position(end), size, first, last);
        }
        report_.shortest_edge = std::min(report_.shortest_edge, shortest);
        report_.longest_edge = std::max(report_.longest_edge, longest);
        report_.largest_valence = std::max(report_.largest_valence, valence);
        report_.valences.add(valence);
        const double ratio = shortest > 0 ? longest / shortest : HUGE_VAL;
        report_.largest_ratio = std::max(report_.largest_ratio, ratio);
        report_.ratios.add(ratio);
    }

    const ShapeReport& report() const { return report_; }

private:
    struct Page {
        VertexId end, third;
    };

    /// The faces at the edge from `from` to `to` are the pages from `first` to `last`. Each lies at an angle round the
    /// edge; the gaps between one and the next are the angles inside the regions there.
    void add_edge(Vec3 from, Vec3 to, double size, std::size_t first, std::size_t last) {
        if (report_.unit > 0) report_.lengths.add(size / report_.unit);
        if (last - first < 2 || size == 0) return;
        const Vec3 axis = (to - from) / size;
        Vec3 x = mesh_.position(pages_[first].third) - from;
        x = x - dot(x, axis) * axis;
        const Vec3 y = cross(axis, x);
        turns_.clear();
        for (std::size_t n = first; n < last; ++n) {
            const Vec3 step = mesh_.position(pages_[n].third) - from;
            turns_.push_back(n == first ? 0 : std::atan2(dot(step, y), dot(step, x)) * 180 / std::numbers::pi);
            if (turns_.back() < 0) turns_.back() += 360;
        }
        std::ranges::sort(turns_);
        turns_.push_back(360);
        for (std::size_t n = 1; n < turns_.size(); ++n) {
            const double gap = turns_[n] - turns_[n - 1];
            report_.least_dihedral = std::min(report_.least_dihedral, gap);
            report_.dihedrals.add(gap);
        }
    }

    const Mesh& mesh_;
    ShapeReport report_;
    std::vector<Page> pages_;
    std::vector<double> turns_;
};

void append(ShapeReport& report, const ShapeReport& later) {
    report.shortest_edge = std::min(report.shortest_edge, later.shortest_edge);
    report.longest_edge = std::max(report.longest_edge, later.longest_edge);
    report.least_dihedral = std::min(report.least_dihedral, later.least_dihedral);
    report.largest_ratio = std::max(report.largest_ratio, later.largest_ratio);
    report.largest_valence = std::max(report.largest_valence, later.largest_valence);
    report.lengths.append(later.lengths);
    report.dihedrals.append(later.dihedrals);
    report.ratios.append(later.ratios);
    report.valences.append(later.valences);
}

}  // namespace

ShapeReport measure_shapes(const Mesh& mesh, std::uint32_t threads) {
    if (mesh.face_count() == 0) return {};
    const double unit = typical_edge(mesh);
    ShapeReport report = StarShapes(mesh, unit).report();
    for_chunks(
        mesh.vertex_end(), kChunk, threads,
        [&](std::uint32_t first, std::uint32_t end) {
            StarShapes shapes(mesh, unit);
            for (std::uint32_t v = first; v < end; ++v)
                if (mesh.is_alive(VertexId{v})) shapes.add(VertexId{v});
            return shapes.report();
        },
        [&](const ShapeReport& later) { append(report, later); });
    if (report.least_dihedral == 360) report.least_dihedral = 0;
    return report;
}

}  // namespace regionmesh
