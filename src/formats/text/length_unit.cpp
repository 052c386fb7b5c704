#include "formats/text/length_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "formats/text/header_text.h"
#include "regionmesh/write_report.h"

namespace regionmesh::formats {
namespace {

constexpr double kFemtometresInMetre = 1e15;

struct LengthUnit {
    std::string_view word;
    double femtometres;
};

/// Those that length_symbol() gives.
constexpr LengthUnit kSymbols[] = {{"fm", 1},   {"pm", 1e3},  {"A", 1e5},      {"nm", 1e6},
                                   {"um", 1e9}, {"mm", 1e12}, {"cm", 1e13},    {"dm", 1e14},
                                   {"m", 1e15}, {"km", 1e18}, {"in", 2.54e13}, {"ft", 3.048e14}};

constexpr LengthUnit kNames[] = {{"femtometer", 1},   {"picometer", 1e3}, {"angstrom", 1e5},    {"nanometer", 1e6},
                                 {"micrometer", 1e9}, {"micron", 1e9},    {"millimeter", 1e12}, {"centimeter", 1e13},
                                 {"decimeter", 1e14}, {"meter", 1e15},    {"kilometer", 1e18},  {"inch", 2.54e13},
                                 {"inches", 2.54e13}, {"foot", 3.048e14}, {"feet", 3.048e14}};

/// Micrometres with the micro sign, with the Greek letter, and as ImageJ writes it.
constexpr std::string_view kMicrometres[] = {"\u00b5m", "\u03bcm", "\\u00B5m"};

/// "millimetres" as "millimeter".
std::string usual_name(std::string_view word) {
    std::string name = lower(word);
    if (name.ends_with("metres") || name.ends_with("metre")) name.replace(name.rfind("metre"), 5, "meter");
    if (name.ends_with("meters") || name == "microns" || name == "angstroms") name.pop_back();
    return name;
}

}  // namespace

std::optional<double> femtometres_in(std::string_view unit) {
    for (const LengthUnit& known : kSymbols)
        if (unit == known.word) return known.femtometres;
    const std::string name = usual_name(unit);
    for (const LengthUnit& known : kNames)
        if (name == known.word) return known.femtometres;
    return std::ranges::find(kMicrometres, unit) != std::end(kMicrometres) ? std::optional(1e9) : std::nullopt;
}

std::optional<double> metres_in(std::string_view unit) {
    const auto femtometres = femtometres_in(unit);
    return femtometres ? std::optional(*femtometres / kFemtometresInMetre) : std::nullopt;
}

std::optional<double> metres_in_quoted(std::string_view units) {
    std::optional<std::string_view> unit;
    for (std::size_t at = units.find('"'); at != std::string_view::npos; at = units.find('"', at + 1)) {
        const std::size_t end = units.find('"', at + 1);
        if (end == std::string_view::npos) return {};
        const std::string_view word = units.substr(at + 1, end - at - 1);
        at = end;
        if (word.empty()) continue;
        if (unit && *unit != word) return {};
        unit = word;
    }
    return unit ? metres_in(*unit) : std::nullopt;
}

}  // namespace regionmesh::formats

namespace regionmesh {

std::string length_symbol(double metres) {
    for (const formats::LengthUnit& known : formats::kSymbols)
        if (known.femtometres / formats::kFemtometresInMetre == metres) return std::string(known.word);
    return fmt::format("{:g} m", metres);
}

}  // namespace regionmesh
