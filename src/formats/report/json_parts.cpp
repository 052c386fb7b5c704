#include "formats/report/json_parts.h"

#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

constexpr double kQualityBin = 0.01;  // widths of the bins of QualityReport
constexpr double kAngleBin = 10;

}  // namespace

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
