// Tables of interfaces and of lines as CSV.
#include <fmt/format.h>

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "formats/report/csv_cell.h"
#include "regionmesh/write_report.h"
#include "surface/edge_measures.h"

namespace regionmesh {
namespace {

/// Labels and names by place in the order of files.
class PlaceTexts {
public:
    explicit PlaceTexts(const FileView& view) : view_(view), order_(view.ordered_labels()) {}

    std::string label(std::uint32_t rank) const { return view_.label_text(at(rank)); }
    std::string name(std::uint32_t rank) const { return is_exterior(rank) ? "exterior" : view_.name(at(rank)); }

private:
    Label at(std::uint32_t rank) const { return is_exterior(rank) ? exterior(0) : order_[rank]; }

    const FileView& view_;
    std::vector<Label> order_;
};

template <class TextOf>
std::string joined(const std::vector<std::uint32_t>& ranks, const char* gap, TextOf&& text_of) {
    std::string text;
    for (const std::uint32_t rank : ranks) {
        if (rank != ranks.front()) text += gap;
        text += text_of(rank);
    }
    return text;
}

}  // namespace

std::string interfaces_csv(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                           const LabelNames& names) {
    const FileView view(mesh, labels, background, names);
    const PlaceTexts texts(view);
    std::string text =
        "label,neighbour,name,neighbour_name,faces,area,centroid_x,centroid_y,centroid_z,mean_curvature,line_length\n";
    for (const auto& [key, sums] : measure_edges(view).interfaces) {
        const Vec3 centroid = sums.area > 0 ? sums.moment / sums.area : Vec3{};
        const std::optional<double> curvature = sums.mean_curvature();
        text += fmt::format("{},{},{},{},{},{:.10g},{:.10g},{:.10g},{:.10g},{},{:.10g}\n", texts.label(key[0]),
                            texts.label(key[1]), csv_cell(texts.name(key[0])), csv_cell(texts.name(key[1])), sums.faces,
                            sums.area, centroid.x, centroid.y, centroid.z,
                            curvature ? fmt::format("{:.10g}", *curvature) : "", sums.line_length);
    }
    return text;
}

std::string lines_csv(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                      const LabelNames& names) {
    const FileView view(mesh, labels, background, names);
    const PlaceTexts texts(view);
    std::string text = "labels,names,label_count,edges,length,angles\n";
    for (const auto& [ranks, sums] : measure_edges(view, true).lines) {
        std::string angles;
        for (std::size_t n = 0; n < ranks.size(); ++n) {
            if (n > 0) angles += ' ';
            angles += sums.angle_length[n] > 0
                          ? fmt::format("{:.6g}", sums.angles[n] / sums.angle_length[n] * 180 / std::numbers::pi)
                          : "-";
        }
        text +=
            fmt::format("{},{},{},{},{:.10g},{}\n", joined(ranks, " ", [&](auto rank) { return texts.label(rank); }),
                        csv_cell(joined(ranks, "; ", [&](auto rank) { return texts.name(rank); })), ranks.size(),
                        sums.edges, sums.length, angles);
    }
    return text;
}

}  // namespace regionmesh
