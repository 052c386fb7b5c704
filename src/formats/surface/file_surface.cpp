#include "formats/surface/file_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

/// Corners of the largest polygon that is split from one corner. A fan of more faces at one vertex makes work in
/// proportion to the square of their number.
constexpr std::size_t kMostInFan = 64;

/// The corners of a polygon from the lowest point on, towards the lower of its neighbours. So the order depends neither
/// on the corner that a file begins with, nor on the side that the polygon is seen from: two that lie back to back are
/// split alike.
class CornersInOrder {
public:
    CornersInOrder(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners) : corners_(corners) {
        const auto place = [&](std::size_t n) {
            const Vec3 p = points[corners[n % corners.size()]];
            return std::tuple(p.x, p.y, p.z);
        };
        const auto before = [&](std::size_t n) { return place(n + corners.size() - 1); };
        const auto neighbours = [&](std::size_t n) { return std::minmax({before(n), place(n + 1)}); };
        // A polygon with a hole may pass its lowest point twice.
        for (std::size_t n = 1; n < corners.size(); ++n)
            if (place(n) < place(first_) || (place(n) == place(first_) && neighbours(n) < neighbours(first_)))
                first_ = n;
        is_reversed_ = before(first_) < place(first_ + 1);
    }
    std::uint32_t operator[](std::size_t n) const {
        return corners_[(first_ + (is_reversed_ ? corners_.size() - n : n)) % corners_.size()];
    }
    /// A triangle of these corners, on the side of the polygon.
    std::array<std::uint32_t, 3> triangle(std::size_t a, std::size_t b, std::size_t c) const {
        if (is_reversed_) std::swap(b, c);
        return {(*this)[a], (*this)[b], (*this)[c]};
    }

private:
    std::span<const std::uint32_t> corners_;
    std::size_t first_ = 0;
    bool is_reversed_;
};

/// Triangles of the polygon from corner `first` to corner `last`: one to the middle, then the two halves. No vertex has
/// more faces than twice the logarithm of the number of corners.
template <class Add>
void split_between(std::size_t first, std::size_t last, Add&& add) {
    if (last - first < 2) return;
    const std::size_t middle = first + (last - first) / 2;
    add(first, middle, last);
    split_between(first, middle, add);
    split_between(middle, last, add);
}

}  // namespace

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
    if (corners.size() == 3) {
        surface.faces.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    const CornersInOrder ordered(surface.points, corners);
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        surface.faces.push_back(ordered.triangle(a, b, c));
    };
    if (corners.size() == 4) {
        const auto squared = [&](std::size_t a, std::size_t b) {
            return length2(surface.points[ordered[a]] - surface.points[ordered[b]]);
        };
        if (squared(1, 3) < squared(0, 2)) {
            add(0, 1, 3);
            add(1, 2, 3);
            return;
        }
    }
    if (corners.size() > kMostInFan) return split_between(0, corners.size() - 1, add);
    for (std::size_t n = 2; n < corners.size(); ++n) add(0, n - 1, n);
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
