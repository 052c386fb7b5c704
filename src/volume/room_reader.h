// Cleans labels near the boundaries of regions, for labels that are noisy or were enlarged from coarser ones.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Throws Error(kUsage) for other numbers than 0 to 8: the kernel of 8 has 4,000 times as many samples as that of 0.5.
void require_room(double room);

/// Returns the sections of another reader. A sample nearer than `room` to the boundary of its region gets the label
/// that has most weight round it: Gaussian, with a standard deviation of `room`, cut off at twice that. Its own label
/// wins ties, then the smallest. No other sample changes. Lengths are in finest spacings; the boundary runs halfway
/// between samples. Small regions may vanish. Holds the sections within the cut-off.
class RoomReader final : public SectionReader {
public:
    /// Requires room > 0. The first holds a reference to the reader. `threads`: 0 for one per core; the result is the
    /// same.
    RoomReader(SectionReader& reader, double room, std::uint32_t threads);
    RoomReader(std::unique_ptr<SectionReader> reader, double room, std::uint32_t threads);

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override;

    /// Samples changed since the beginning or the last rewind.
    std::uint64_t changed() const { return changed_; }

private:
    /// A step to another sample: along the section's axes, and across sections.
    struct Offset {
        std::int32_t i, j, section;
        float weight;
    };

    using Weights = std::vector<std::pair<InputLabel, float>>;  // label and weight, in the order met

    void make_offsets(double room);
    void read_ahead();
    std::uint64_t clean_row(std::uint32_t row, std::span<InputLabel> out) const;
    InputLabel cleaned(std::int32_t i, std::int32_t j, Weights& weights) const;
    const InputLabel* neighbour(std::int32_t i, std::int32_t j, const Offset& offset) const;

    std::unique_ptr<SectionReader> own_ = {};
    SectionReader& reader_;
    VolumeInfo info_;
    std::uint32_t threads_;
    std::vector<Offset> near_;    // steps over a boundary within the room
    std::vector<Offset> kernel_;  // steps with weight; the first is none
    std::int32_t reach_ = 0;      // sections on each side
    std::deque<std::vector<InputLabel>> held_;
    std::int64_t first_held_ = 0, section_ = 0;
    std::uint64_t changed_ = 0;
};

}  // namespace regionmesh
