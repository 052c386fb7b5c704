#include "formats/surface/file_surface.h"

namespace regionmesh {

void add_polygon(FileSurface& surface, std::span<const std::uint32_t> corners,
                 const std::array<InputLabel, 2>& labels) {
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        surface.faces.push_back({corners[a], corners[b], corners[c]});
        surface.labels.push_back(labels);
    };
    if (corners.size() == 4) {
        const auto squared = [&](std::size_t a, std::size_t b) {
            return length2(surface.points[corners[a]] - surface.points[corners[b]]);
        };
        if (squared(1, 3) < squared(0, 2)) {
            add(0, 1, 3);
            add(1, 2, 3);
            return;
        }
    }
    for (std::size_t n = 2; n < corners.size(); ++n) add(0, n - 1, n);
}

void append(FileSurface& surface, const FileSurface& other) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    surface.is_on_hull.clear();
    surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
    surface.labels.insert(surface.labels.end(), other.labels.begin(), other.labels.end());
    for (const auto& [a, b, c] : other.faces) surface.faces.push_back({first + a, first + b, first + c});
}

}  // namespace regionmesh
