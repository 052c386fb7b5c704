// Which label the labels round a sample suggest, and how far a sample is from the boundary of its region.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_table.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Consecutive sections of dense labels.
struct LabelWindow {
    std::uint32_t width = 0, height = 0;
    std::uint32_t first = 0;  // section
    std::deque<std::vector<Label>> sections = {};

    std::uint32_t end() const { return first + static_cast<std::uint32_t>(sections.size()); }
    std::vector<Label>& section(std::uint32_t s) { return sections[s - first]; }
    const std::vector<Label>& section(std::uint32_t s) const { return sections[s - first]; }
    /// Nothing outside the window, or the volume.
    const Label* at(std::int64_t i, std::int64_t j, std::int64_t s) const {
        const bool is_inside = i >= 0 && i < width && j >= 0 && j < height && s >= first && s < end();
        return is_inside ? &sections[static_cast<std::size_t>(s - first)][static_cast<std::size_t>(j * width + i)]
                         : nullptr;
    }
};

/// A step to another sample along the axes of the sweep, with a weight or a distance.
struct LabelStep {
    std::int32_t i, j, k;
    float value;
};

/// Steps to samples of other labels by the distance of the boundary on the way, halfway between samples; the nearest
/// first, up to `distance`. `steps`: spacings along the axes of the sweep, in the unit of the distance.
class BoundaryDistance {
public:
    BoundaryDistance(Vec3 spacing, double distance);
    std::uint32_t reach() const { return reach_; }
    /// Is the distance at most that of one step in each direction?
    bool is_short() const { return is_short_; }
    /// Of the sample from the boundary of its region; negative if it is farther than `distance`.
    float of(const LabelWindow& window, std::int64_t i, std::int64_t j, std::int64_t s) const;

private:
    std::vector<LabelStep> steps_;
    std::uint32_t reach_ = 0;
    bool is_short_ = true;
};

/// The label with most weight round a sample: Gaussian, cut off at twice its standard deviation. The own label wins
/// ties, then the smallest.
class SmoothLabels {
public:
    /// The table must outlive this object.
    SmoothLabels(Vec3 spacing, double deviation, const LabelTable& labels);
    /// Sections on each side that it reads.
    static std::uint32_t reach_of(Vec3 spacing, double deviation);
    using Weights = std::vector<std::pair<Label, float>>;
    Label of(const LabelWindow& window, std::int64_t i, std::int64_t j, std::int64_t s, Weights& weights) const;

private:
    const LabelTable& labels_;
    std::vector<LabelStep> kernel_;
};

}  // namespace regionmesh
