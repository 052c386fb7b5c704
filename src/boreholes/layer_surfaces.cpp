#include "boreholes/layer_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"

namespace regionmesh::formats {
namespace {

constexpr int kMostRounds = 8;  // rounds that add bounds which the surface violates

bool is_known(const Contact& contact) {
    return contact.kind == ContactKind::kAt || contact.kind == ContactKind::kGround;
}

bool are_near(const HeightSample& a, const HeightSample& b, double near) {
    return std::hypot(a.x - b.x, a.y - b.y) <= near;
}

/// The tightest bound of each kind at one position; none where a sample has the height. Kriging takes the mean of
/// samples at one position: a mean with a bound would satisfy neither.
std::vector<Contact> tightest(const std::vector<Contact>& bounds, const std::vector<HeightSample>& samples,
                              double near) {
    std::vector<Contact> kept;
    for (const Contact& bound : bounds) {
        const HeightSample position{bound.x, bound.y, bound.z};
        if (std::ranges::any_of(samples, [&](const HeightSample& sample) { return are_near(sample, position, near); }))
            continue;
        const auto same = std::ranges::find_if(kept, [&](const Contact& other) {
            return other.kind == bound.kind && are_near({other.x, other.y, other.z}, position, near);
        });
        if (same == kept.end())
            kept.push_back(bound);
        else
            same->z = bound.kind == ContactKind::kAtMost ? std::min(same->z, bound.z) : std::max(same->z, bound.z);
    }
    return kept;
}

/// The base of one unit.
Kriging base_of(const std::vector<Contact>& contacts, const Ground& ground, std::uint32_t threads) {
    std::vector<HeightSample> samples;
    std::vector<Contact> bounds;
    for (const Contact& contact : contacts) {
        const double z = contact.kind == ContactKind::kGround ? ground.at(contact.x, contact.y) : contact.z;
        if (is_known(contact))
            samples.push_back({contact.x, contact.y, z});
        else
            bounds.push_back(contact);
    }
    std::vector<HeightSample> positions = samples;
    for (const Contact& bound : bounds) positions.push_back({bound.x, bound.y, bound.z});
    const double near = near_distance(positions);
    bounds = tightest(bounds, samples, near);
    if (samples.empty())
        for (const Contact& bound : std::exchange(bounds, {})) samples.push_back({bound.x, bound.y, bound.z});
    Kriging base(samples, near, threads);
    for (int round = 0; round < kMostRounds && !bounds.empty(); ++round) {
        const std::size_t count = bounds.size();
        std::erase_if(bounds, [&](const Contact& bound) {
            const double z = base.at(bound.x, bound.y);
            const bool is_kept = bound.kind == ContactKind::kAtMost ? z <= bound.z : z >= bound.z;
            if (!is_kept) samples.push_back({bound.x, bound.y, bound.z});
            return !is_kept;
        });
        if (bounds.size() == count) break;
        base = Kriging(samples, near, threads);
    }
    return base;
}

std::vector<double> surface_at(const ColumnGrid& grid, const auto& surface, std::uint32_t threads) {
    std::vector<double> heights(grid.size());
    parallel_for(grid.height, threads, [&](std::uint32_t j) {
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

std::vector<double> heights_of(const Ground& ground, const ColumnGrid& grid, std::uint32_t threads) {
    return surface_at(grid, ground, threads);
}

LayerSurfaces interpolate(const LayerOrder& order, const Ground& ground, std::vector<double> heights,
                          const ColumnGrid& grid, std::uint32_t threads) {
    LayerSurfaces surfaces;
    surfaces.heights.push_back(std::move(heights));
    for (const std::vector<Contact>& contacts : order.contacts) {
        std::vector<double> base = surface_at(grid, base_of(contacts, ground, threads), threads);
        for (std::size_t n = 0; n < base.size(); ++n)
            base[n] = std::min(base[n], surfaces.heights.back()[n]);  // younger units cut older ones
        surfaces.heights.push_back(std::move(base));
    }
    return surfaces;
}

}  // namespace regionmesh::formats
