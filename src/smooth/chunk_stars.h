// The faces round each vertex of a chunk.
#pragma once

#include <span>
#include <vector>

#include "smooth/surface_window.h"

namespace regionmesh {

/// Corners as face * 4 + place, by vertex.
class ChunkStars {
public:
    /// Requires that the chunk after it is in the window, if there is one.
    ChunkStars(const SurfaceWindow& window, std::uint32_t chunk);

    NumberRange vertices() const { return vertices_; }
    std::span<const std::uint32_t> of(std::uint32_t v) const {
        const std::uint32_t n = v - vertices_.first;
        return {corners_.data() + start_[n], start_[n + 1] - start_[n]};
    }

private:
    NumberRange vertices_;
    std::vector<std::uint32_t> start_, corners_;
};

}  // namespace regionmesh
