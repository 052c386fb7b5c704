#include "smooth/chunk_stars.h"

namespace regionmesh {

ChunkStars::ChunkStars(const SurfaceWindow& window, std::uint32_t chunk) : vertices_(window.vertices_of(chunk)) {
    NumberRange faces = window.faces_of(chunk);
    if (chunk + 1 < window.chunk_end()) faces.end = window.faces_of(chunk + 1).end;
    const auto for_corners = [&](auto&& visit) {
        for (std::uint32_t f = faces.first; f < faces.end; ++f)
            for (std::uint32_t place = 0; place < 3; ++place) {
                const std::uint32_t n = window.faces[f].vertices[place] - vertices_.first;
                if (n < vertices_.size()) visit(n, f << 2 | place);
            }
    };
    start_.assign(vertices_.size() + 1, 0);
    for_corners([&](std::uint32_t n, std::uint32_t) { ++start_[n + 1]; });
    for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    corners_.resize(start_.back());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for_corners([&](std::uint32_t n, std::uint32_t corner) { corners_[next[n]++] = corner; });
}

}  // namespace regionmesh
