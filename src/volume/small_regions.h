// The label that a small region gets.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "regionmesh/label.h"

namespace regionmesh {

/// Small regions, their sizes in samples and the areas of their interfaces.
class SmallRegions {
public:
    /// Order of labels.
    explicit SmallRegions(InputLabelOrder order) : less_(order) {}
    /// Returns the number of the region.
    std::uint32_t add(InputLabel label, std::uint64_t samples);
    std::size_t size() const { return regions_.size(); }

    void add_contact_of_small(std::uint32_t a, std::uint32_t b, double area);
    void add_contact(std::uint32_t small, InputLabel large, double area) { regions_[small].large[large] += area; }

    /// Joins regions of fewer than `min_samples` samples to neighbours, the smallest first, until none is left. Returns
    /// the new label of each. A region without neighbours keeps its label.
    std::vector<InputLabel> resolve(std::uint64_t min_samples);

private:
    struct Region {
        InputLabel label;
        std::uint64_t samples;
        std::map<std::uint32_t, double> small = {};  // areas of the interfaces with other small regions
        std::map<InputLabel, double> large = {};     // interface with all others, by label
        std::uint32_t joined;                        // region that it joins; itself: none
    };

    InputLabel nearest_label(const Region& region) const;
    void absorb(std::uint32_t region, std::uint32_t other);
    void make_large(std::uint32_t region);

    InputLabelOrder less_;
    std::vector<Region> regions_;
    std::set<std::pair<std::uint64_t, std::uint32_t>> queue_;  // samples and number
};

}  // namespace regionmesh
