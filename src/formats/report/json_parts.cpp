#include "formats/report/json_parts.h"

#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

constexpr double kQualityBin = 0.01;  // widths of the bins of QualityReport
constexpr double kAngleBin = 10;

template <std::size_t kBins>
Json histogram_json(const Histogram<kBins>& histogram) {
    return {{"first", histogram.first}, {"bin_width", histogram.width}, {"counts", histogram.counts}};
}

}  // namespace

Json shapes_json(const ShapeReport& shapes) {
    return {{"unit", shapes.unit},
            {"shortest_edge", shapes.shortest_edge},
            {"longest_edge", shapes.longest_edge},
            {"least_dihedral", shapes.least_dihedral},
            {"largest_ratio", shapes.largest_ratio},
            {"largest_valence", shapes.largest_valence},
            {"edge_lengths", histogram_json(shapes.lengths)},
            {"dihedrals", histogram_json(shapes.dihedrals)},
            {"ratios", histogram_json(shapes.ratios)},
            {"valences", histogram_json(shapes.valences)}};
}

Json quality_json(const QualityReport& quality) {
    return {{"min", quality.min},
            {"mean", quality.mean},
            {"histogram", {{"bin_width", kQualityBin}, {"counts", quality.histogram}}},
            {"min_angle", quality.min_angle},
            {"max_angle", quality.max_angle},
            {"angles", {{"bin_width", kAngleBin}, {"counts", quality.angle_histogram}}}};
}

Json label_json(InputLabel label, const LabelTable& labels) {
    return labels.is_unsigned() ? Json(static_cast<std::uint64_t>(label)) : Json(label);
}

void put_unit(const std::optional<double>& metres, Json& json) {
    if (metres) json["unit"] = length_symbol(*metres);
}

void put_roughness(const Roughness& roughness, Json& json) {
    json["roughness"] = {{"text", roughness.text()},
                         {"enlarged", roughness.enlarged},
                         {"ragged", roughness.ragged},
                         {"stray", roughness.stray}};
}

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

}  // namespace regionmesh
