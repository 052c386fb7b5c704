#include "formats/surface/file_surface.h"

#include <fmt/format.h>

#include "formats/input_file.h"
#include "formats/surface/cut_polygon.h"
#include "formats/text/header_text.h"
#include "regionmesh/limits.h"

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

namespace {

std::optional<Vec3> take_vector(std::string_view text) {
    Vec3 vector;
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = formats::parse_finite(formats::take_word(text));
        if (!number) return {};
        vector[axis] = *number;
    }
    return vector;
}

}  // namespace

void read_space(FileSurface& surface, std::string_view text) {
    if (text.find("SPACE=RAS") != std::string_view::npos) surface.coordinates.space = Space::kRas;
    if (text.find("SPACE=LPS") != std::string_view::npos) surface.coordinates.space = Space::kLps;
}

void read_comment(FileSurface& surface, std::string_view comment) {
    read_space(surface, comment);
    const std::string_view word = formats::take_word(comment);
    if (word == "metres_per_unit") set_metres(surface, formats::parse_finite(formats::take_word(comment)).value_or(0));
    if (word == "sample_spacing") set_spacing(surface, take_vector(comment).value_or(Vec3{}));
    const auto label = formats::parse_label(formats::take_word(comment));
    if (!label) return;
    const std::string name = formats::one_line(comment);
    if (name.empty() && word == "exterior_label") surface.exterior_label = *label;
    if (name.empty() && word == "unsigned_labels") surface.is_unsigned = *label != 0;
    if (name.empty() && word == "no_background") surface.background.emplace();
    if (name.empty() && word == "background") {
        if (!surface.background) surface.background.emplace();
        surface.background->push_back(*label);
    }
    if (word == "colour")
        if (const auto colour = formats::parse_colour(name)) surface.colours.try_emplace(*label, *colour);
    if (word == "region" && !name.empty()) surface.names.try_emplace(*label, name);
}

std::vector<std::string> coordinate_comments(const Coordinates& coordinates) {
    std::vector<std::string> comments;
    const auto& [space, metres, spacing] = coordinates;
    if (space != Space::kUnknown) comments.push_back(std::string("SPACE=") + space_name(space));
    if (metres) comments.push_back(fmt::format("metres_per_unit {}", *metres));
    if (spacing) comments.push_back(fmt::format("sample_spacing {} {} {}", spacing->x, spacing->y, spacing->z));
    return comments;
}

void set_metres(FileSurface& surface, double metres) {
    if (is_unit_of_length(metres)) surface.coordinates.metres = metres;
}

void set_spacing(FileSurface& surface, Vec3 spacing) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(spacing[axis] >= kLeastLength && spacing[axis] <= kMostLength)) return;
    surface.coordinates.spacing = spacing;
}

void append(FileSurface& surface, const FileSurface& other) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    surface.is_on_hull.clear();
    surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
    surface.labels.insert(surface.labels.end(), other.labels.begin(), other.labels.end());
    for (const auto& [a, b, c] : other.faces) surface.faces.push_back({first + a, first + b, first + c});
}

}  // namespace regionmesh
