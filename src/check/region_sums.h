// Sums by region over a part of the mesh; stores only the regions that occur there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "regionmesh/check.h"

namespace regionmesh {

class RegionSums {
public:
    RegionReport& operator[](Label label) {
        if (label >= places_.size() || places_[label] == kNone) add(label);
        return sums_[places_[label]];
    }
    std::vector<RegionReport> take() { return std::move(sums_); }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    [[gnu::noinline]] void add(Label label) {  // rarely: not copied into each loop
        if (label >= places_.size()) places_.resize(label + 1, kNone);
        places_[label] = static_cast<std::uint32_t>(sums_.size());
        sums_.push_back({.label = label});
    }

    std::vector<std::uint32_t> places_;  // index of the region of each label
    std::vector<RegionReport> sums_;
};

/// Adds the sums of a part to the totals, which are by dense label.
inline void add_to(std::vector<RegionReport>& regions, const std::vector<RegionReport>& part) {
    for (const RegionReport& sum : part) {
        if (sum.label >= regions.size()) regions.resize(sum.label + 1);
        RegionReport& region = regions[sum.label];
        region.euler += sum.euler;
        region.components += sum.components;
        region.volume += sum.volume;
        region.area += sum.area;
    }
}

}  // namespace regionmesh
