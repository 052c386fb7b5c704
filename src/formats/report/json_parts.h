// Parts that the JSON of all reports shares.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "regionmesh/check.h"
#include "regionmesh/denoise.h"
#include "regionmesh/label_table.h"

namespace regionmesh {

using Json = nlohmann::ordered_json;

Json quality_json(const QualityReport& quality);
Json shapes_json(const ShapeReport& shapes);

/// A number in the signedness of the input.
Json label_json(InputLabel label, const LabelTable& labels);

/// `unit` of length, where it is known.
void put_unit(const std::optional<double>& metres, Json& json);

/// `roughness` of labels.
void put_roughness(const Roughness& roughness, Json& json);

/// Two spaces of indent, a newline at the end; a number that is not finite is null.
std::string text_of(const Json& json);

}  // namespace regionmesh
