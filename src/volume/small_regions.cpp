#include "volume/small_regions.h"

#include <algorithm>

namespace regionmesh {

std::uint32_t SmallRegions::add(InputLabel label, std::uint64_t samples) {
    const auto number = static_cast<std::uint32_t>(regions_.size());
    regions_.push_back({.label = label, .samples = samples, .joined = number});
    return number;
}

void SmallRegions::add_contact_of_small(std::uint32_t a, std::uint32_t b, double area) {
    regions_[a].small[b] += area;
    regions_[b].small[a] += area;
}

/// The label with the largest interface, the smallest of several. Requires a neighbour.
InputLabel SmallRegions::nearest_label(const Region& region) const {
    std::map<InputLabel, double> areas = region.large;
    for (const auto& [other, area] : region.small) areas[regions_[other].label] += area;
    return std::max_element(areas.begin(), areas.end(),
                            [&](const auto& a, const auto& b) {
                                return a.second < b.second || (a.second == b.second && less_(b.first, a.first));
                            })
        ->first;
}

/// Makes `other` part of `region`.
void SmallRegions::absorb(std::uint32_t region, std::uint32_t other) {
    Region& to = regions_[region];
    Region& from = regions_[other];
    queue_.erase({from.samples, other});
    to.samples += from.samples;
    from.joined = region;
    for (const auto& [label, area] : from.large) to.large[label] += area;
    for (const auto& [neighbour, area] : from.small) {
        regions_[neighbour].small.erase(other);
        if (neighbour == region) continue;
        to.small[neighbour] += area;
        regions_[neighbour].small[region] += area;
    }
    from.small.clear();
    from.large.clear();
}

/// Its neighbours see it as a large region from now on.
void SmallRegions::make_large(std::uint32_t region) {
    for (const auto& [neighbour, area] : regions_[region].small) {
        regions_[neighbour].small.erase(region);
        regions_[neighbour].large[regions_[region].label] += area;
    }
    regions_[region].small.clear();
    regions_[region].large.clear();
}

std::vector<InputLabel> SmallRegions::resolve(std::uint64_t min_samples) {
    for (std::uint32_t n = 0; n < regions_.size(); ++n) queue_.emplace(regions_[n].samples, n);
    while (!queue_.empty()) {
        const std::uint32_t smallest = queue_.begin()->second;
        const Region& region = regions_[smallest];
        if (region.small.empty() && region.large.empty()) {
            queue_.erase(queue_.begin());
            continue;
        }
        const InputLabel label = nearest_label(region);
        const bool joins_large = region.large.contains(label);
        std::vector<std::uint32_t> same{smallest};
        for (const auto& [other, area] : region.small)
            if (regions_[other].label == label) same.push_back(other);
        // The one with the most neighbours takes in the others, since all neighbours of those have to be told.
        const std::uint32_t joint = *std::ranges::max_element(
            same, {}, [&](std::uint32_t n) { return regions_[n].small.size() + regions_[n].large.size(); });
        queue_.erase({regions_[joint].samples, joint});
        regions_[joint].label = label;
        for (const std::uint32_t other : same)
            if (other != joint) absorb(joint, other);
        if (joins_large || regions_[joint].samples >= min_samples)
            make_large(joint);
        else
            queue_.emplace(regions_[joint].samples, joint);
    }
    std::vector<InputLabel> labels;
    for (std::uint32_t n = 0; n < regions_.size(); ++n) {
        std::uint32_t root = n;
        while (regions_[root].joined != root) root = regions_[root].joined = regions_[regions_[root].joined].joined;
        labels.push_back(regions_[root].label);
    }
    return labels;
}

}  // namespace regionmesh
