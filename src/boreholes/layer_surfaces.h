// The ground and the bases of units on a grid of columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "boreholes/kriging.h"
#include "boreholes/layer_order.h"
#include "boreholes/terrain.h"

namespace regionmesh::formats {

/// Columns at (x + i * dx, y + j * dy).
struct ColumnGrid {
    std::uint32_t width = 0, height = 0;
    double x = 0, y = 0, dx = 1, dy = 1;

    std::size_t size() const { return std::size_t{width} * height; }
};

/// Surfaces on a grid, each as heights with i fastest: the ground, then the base of each unit but the oldest, from
/// young to old. No surface lies above the one before.
struct LayerSurfaces {
    std::vector<std::vector<double>> heights;

    /// The number of surfaces below which a position of column n lies: 0 is above the ground, 1 the youngest unit.
    std::size_t layer_of(std::size_t column, double z) const;
};

/// Heights of the ground: those of the terrain, and between `collars` where it has none.
class Ground {
public:
    /// Requires 1 to kMostHoles collars. `terrain` may be null.
    Ground(const std::vector<HeightSample>& collars, const Terrain* terrain, std::uint32_t threads)
        : between_(collars, near_distance(collars), threads), terrain_(terrain) {}

    double at(double x, double y) const {
        if (const auto height = terrain_ ? terrain_->at(x, y) : std::nullopt) return *height;
        return between_.at(x, y);
    }

private:
    Kriging between_;
    const Terrain* terrain_;
};

/// The heights of the ground at the columns.
std::vector<double> heights_of(const Ground& ground, const ColumnGrid& grid, std::uint32_t threads);

/// Interpolates the bases between the contacts, below the heights of the ground at the columns. A contact that only
/// bounds a base takes part where the base interpolated without it is out of bounds; of the bounds at one position, the
/// tightest of each kind, unless another hole there has the contact. `threads` as in parallel_for().
LayerSurfaces interpolate(const LayerOrder& order, const Ground& ground, std::vector<double> heights,
                          const ColumnGrid& grid, std::uint32_t threads);

}  // namespace regionmesh::formats
