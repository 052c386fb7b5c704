// A table of regions as CSV.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "formats/report/csv_cell.h"
#include "regionmesh/write_report.h"
#include "surface/edge_measures.h"
#include "surface/file_view.h"

namespace regionmesh {
namespace {

/// Sums over the faces of one region, turned outward.
struct RegionSums {
    std::uint64_t faces = 0;
    double area = 0, volume = 0;
    Vec3 moment{};  // integral of the position over the volume
    Box box;
    std::map<std::uint32_t, double> neighbours;  // by rank: area of the interface
};

/// Adds the tetrahedron between the face and `middle`, which keeps the sums small.
void add_face(RegionSums& sums, const std::array<Vec3, 3>& corners, Vec3 middle) {
    const Vec3 a = corners[0] - middle, b = corners[1] - middle, c = corners[2] - middle;
    const double volume = dot(a, cross(b, c)) / 6;
    ++sums.faces;
    sums.area += 0.5 * length(cross(b - a, c - a));
    sums.volume += volume;
    sums.moment += (volume / 4) * (a + b + c);
    for (const Vec3& corner : corners) sums.box.add(corner);
}

std::vector<RegionSums> sums_of(const FileView& view, Vec3 middle) {
    std::vector<RegionSums> sums(view.labels().size());
    view.for_faces([&](FaceId f) {
        const Mesh& mesh = view.mesh();
        const auto [a, b, c] = mesh[f].vertices;
        for (const int side : {0, 1}) {
            const Label own = mesh[f].labels[side], other = mesh[f].labels[1 - side];
            if (is_exterior(own)) continue;
            const std::array<Vec3, 3> corners{mesh.position(a), mesh.position(side == 0 ? b : c),
                                              mesh.position(side == 0 ? c : b)};
            add_face(sums[own], corners, middle);
            if (is_exterior(other) || view.is_background(other)) continue;
            sums[own].neighbours[view.rank(other)] +=
                0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
        }
    });
    return sums;
}

/// By place in the order of files: the mean curvature of interfaces that have one, times their area; that area; and the
/// length of triple lines.
struct EdgeSums {
    double curvature = 0, area = 0, line_length = 0;
};

std::vector<EdgeSums> edge_sums_of(const FileView& view) {
    std::vector<EdgeSums> sums(view.region_ranks());
    const EdgeMeasures measures = measure_edges(view);
    for (const auto& [key, interface] : measures.interfaces) {
        const std::optional<double> curvature = interface.mean_curvature();
        if (!curvature) continue;
        for (const std::size_t side : {0u, 1u}) {
            if (key[side] >= sums.size()) continue;
            sums[key[side]].curvature += (side == 0 ? *curvature : -*curvature) * interface.area;
            sums[key[side]].area += interface.area;
        }
    }
    for (const auto& [ranks, line] : measures.lines)
        if (!is_exterior(ranks.back()))
            for (const std::uint32_t rank : ranks)
                if (rank < sums.size()) sums[rank].line_length += line.length;
    return sums;
}

}  // namespace

std::string regions_csv(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                        const LabelNames& names) {
    const FileView view(mesh, labels, background, names);
    Box box;
    view.for_vertices([&](VertexId v) { box.add(mesh.position(v)); });
    const Vec3 middle = box.is_empty() ? Vec3{} : 0.5 * (box.low + box.high);
    const std::vector<RegionSums> all = sums_of(view, middle);
    const std::vector<EdgeSums> edges = edge_sums_of(view);
    const std::vector<Label> order = view.ordered_labels();
    std::string text =
        "label,name,faces,volume,area,centroid_x,centroid_y,centroid_z,box_low_x,box_low_y,box_low_z,box_high_x,"
        "box_high_y,box_high_z,equivalent_diameter,neighbours,neighbour_areas,"
        "mean_curvature,triple_line_length\n";
    for (const Label label : order) {
        const RegionSums& sums = all[label];
        if (sums.faces == 0 || view.is_background(label)) continue;
        const Vec3 centroid = sums.volume != 0 ? middle + sums.moment / sums.volume : middle;
        const double diameter = std::cbrt(6 * std::abs(sums.volume) / std::numbers::pi);
        text += fmt::format("{},{},{},{:.10g},{:.10g}", view.label_text(label), csv_cell(view.name(label)), sums.faces,
                            sums.volume, sums.area);
        for (const Vec3& place : {centroid, sums.box.low, sums.box.high})
            text += fmt::format(",{:.10g},{:.10g},{:.10g}", place.x, place.y, place.z);
        std::string neighbours, areas;
        for (const auto& [rank, area] : sums.neighbours) {
            const char* gap = neighbours.empty() ? "" : " ";
            neighbours += gap + view.label_text(order[rank]);
            areas += fmt::format("{}{:.10g}", gap, area);
        }
        const EdgeSums& at_edges = edges[view.rank(label)];
        text += fmt::format(",{:.10g},{},{},{},{:.10g}\n", diameter, neighbours, areas,
                            at_edges.area > 0 ? fmt::format("{:.10g}", at_edges.curvature / at_edges.area) : "",
                            at_edges.line_length);
    }
    return text;
}

}  // namespace regionmesh
