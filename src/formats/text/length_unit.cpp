#include "formats/text/length_unit.h"

#include <fmt/format.h>

#include "formats/text/header_text.h"
#include "regionmesh/write_report.h"

namespace regionmesh::formats {
namespace {

constexpr double kFemtometresInMetre = 1e15;

struct LengthUnit {
    std::string_view symbol, name;
    double femtometres;
};

constexpr LengthUnit kUnits[] = {
    {"fm", "femtometer", 1},   {"pm", "picometer", 1e3},   {"A", "angstrom", 1e5},     {"nm", "nanometer", 1e6},
    {"um", "micrometer", 1e9}, {"mm", "millimeter", 1e12}, {"cm", "centimeter", 1e13}, {"dm", "decimeter", 1e14},
    {"m", "meter", 1e15},      {"km", "kilometer", 1e18},  {"in", "inch", 2.54e13},    {"ft", "foot", 3.048e14},
};

/// Other names in use.
constexpr LengthUnit kOthers[] = {{"\u00b5m", "micron", 1e9}, {"\u03bcm", "feet", 3.048e14}};

/// "millimetres" as "millimeter".
std::string usual_name(std::string_view word) {
    std::string name = lower(word);
    if (name.ends_with("metres") || name.ends_with("metre")) name.replace(name.rfind("metre"), 5, "meter");
    if (name.size() > 5 && name.ends_with('s')) name.pop_back();
    return name;
}

}  // namespace

std::optional<double> femtometres_in(std::string_view unit) {
    const std::string name = usual_name(unit);
    for (const LengthUnit& known : kUnits)
        if (unit == known.symbol || name == known.name) return known.femtometres;
    for (const LengthUnit& known : kOthers)
        if (unit == known.symbol || name == known.name) return known.femtometres;
    return {};
}

std::optional<double> metres_in(std::string_view unit) {
    const auto femtometres = femtometres_in(unit);
    return femtometres ? std::optional(*femtometres / kFemtometresInMetre) : std::nullopt;
}

}  // namespace regionmesh::formats

namespace regionmesh {

std::string length_symbol(double metres) {
    for (const formats::LengthUnit& known : formats::kUnits)
        if (known.femtometres / formats::kFemtometresInMetre == metres) return std::string(known.symbol);
    return fmt::format("{:g} m", metres);
}

}  // namespace regionmesh
