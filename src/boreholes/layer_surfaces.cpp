#include "boreholes/layer_surfaces.h"

#include <algorithm>

#include "base/parallel_for.h"

namespace regionmesh::formats {
namespace {

constexpr int kMostRounds = 8;  // of taking in bounds that are not kept

bool is_known(const Contact& contact) {
    return contact.kind == ContactKind::kAt || contact.kind == ContactKind::kGround;
}

/// The base of one unit.
Kriging base_of(const std::vector<Contact>& contacts, const Ground& ground) {
    std::vector<HeightSample> samples;
    std::vector<Contact> bounds;
    for (const Contact& contact : contacts) {
        const double z = contact.kind == ContactKind::kGround ? ground.at(contact.x, contact.y) : contact.z;
        if (is_known(contact))
            samples.push_back({contact.x, contact.y, z});
        else
            bounds.push_back(contact);
    }
    if (samples.empty())
        for (const Contact& bound : std::exchange(bounds, {})) samples.push_back({bound.x, bound.y, bound.z});
    Kriging base(samples);
    for (int round = 0; round < kMostRounds && !bounds.empty(); ++round) {
        const std::size_t count = bounds.size();
        std::erase_if(bounds, [&](const Contact& bound) {
            const double z = base.at(bound.x, bound.y);
            const bool is_kept = bound.kind == ContactKind::kAtMost ? z <= bound.z : z >= bound.z;
            if (!is_kept) samples.push_back({bound.x, bound.y, bound.z});
            return !is_kept;
        });
        if (bounds.size() == count) break;
        base = Kriging(samples);
    }
    return base;
}

std::vector<double> heights_of(const ColumnGrid& grid, const auto& surface) {
    std::vector<double> heights(grid.size());
    parallel_for(grid.height, 0, [&](std::uint32_t j) {
        for (std::uint32_t i = 0; i < grid.width; ++i)
            heights[std::size_t{j} * grid.width + i] = surface.at(grid.x + i * grid.dx, grid.y + j * grid.dy);
    });
    return heights;
}

}  // namespace

std::size_t LayerSurfaces::layer_of(std::size_t column, double z) const {
    const auto below = std::partition_point(heights.begin(), heights.end(),
                                            [&](const std::vector<double>& surface) { return z <= surface[column]; });
    return static_cast<std::size_t>(below - heights.begin());
}

LayerSurfaces interpolate(const LayerOrder& order, const Ground& ground, const ColumnGrid& grid) {
    LayerSurfaces surfaces;
    surfaces.heights.push_back(heights_of(grid, ground));
    for (const std::vector<Contact>& contacts : order.contacts) {
        std::vector<double> heights = heights_of(grid, base_of(contacts, ground));
        for (std::size_t n = 0; n < heights.size(); ++n)
            heights[n] = std::min(heights[n], surfaces.heights.back()[n]);  // younger units cut older ones
        surfaces.heights.push_back(std::move(heights));
    }
    return surfaces;
}

}  // namespace regionmesh::formats
