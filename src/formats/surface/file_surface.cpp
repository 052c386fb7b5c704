#include "formats/surface/file_surface.h"

#include <fmt/format.h>

#include "formats/input_file.h"
#include "formats/surface/cut_polygon.h"
#include "formats/text/header_text.h"

namespace regionmesh {

void add_point(FileSurface& surface, Vec3 point, const std::filesystem::path& path) {
    if (!is_finite(point))
        formats::fail(path, fmt::format("point {} has a coordinate that is not finite", surface.points.size()));
    if (surface.points.size() >= kMostVertices) formats::fail(path, "has more points than a model can hold");
    surface.points.push_back(point);
}

void add_polygon(FileSurface& surface, std::span<const std::uint32_t> corners, const std::array<InputLabel, 2>& labels,
                 const std::filesystem::path& path) {
    if (surface.faces.size() + corners.size() - 2 > kMostFaces)
        formats::fail(path, "has more faces than a model can hold");
    surface.labels.insert(surface.labels.end(), corners.size() - 2, labels);
    cut_polygon(surface.points, corners, surface.faces);
}

Vec3 take_point(const formats::ByteReader& file, std::string_view& line) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = formats::take_word(line);
        const auto value = formats::parse_finite(word);
        if (!value) file.fail_line(fmt::format("'{}' stands where a coordinate belongs", formats::shown(word)));
        point[axis] = *value;
    }
    return point;
}

void read_comment(FileSurface& surface, std::string_view comment) {
    if (comment.find("SPACE=RAS") != std::string_view::npos) surface.space = Space::kRas;
    if (comment.find("SPACE=LPS") != std::string_view::npos) surface.space = Space::kLps;
    const std::string_view word = formats::take_word(comment);
    const auto label = formats::parse_label(formats::take_word(comment));
    if (!label) return;
    const std::string name = formats::one_line(comment);
    if (word == "exterior_label") surface.exterior_label = *label;
    if (word == "no_background") surface.background.emplace();
    if (word == "background") {
        if (!surface.background) surface.background.emplace();
        surface.background->push_back(*label);
    }
    if (word == "colour")
        if (const auto colour = formats::parse_colour(name)) surface.colours.try_emplace(*label, *colour);
    if (word == "region" && !name.empty()) surface.names.try_emplace(*label, name);
}

void append(FileSurface& surface, const FileSurface& other) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    surface.is_on_hull.clear();
    surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
    surface.labels.insert(surface.labels.end(), other.labels.begin(), other.labels.end());
    for (const auto& [a, b, c] : other.faces) surface.faces.push_back({first + a, first + b, first + c});
}

}  // namespace regionmesh
