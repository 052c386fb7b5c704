// Two consecutive sections with dense labels.
#pragma once

#include <span>
#include <vector>

#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Throws Error(kInput) for a volume of one sample along an axis, and what require_sweep() throws.
void require_cells(const VolumeInfo& info);

/// Reads sections one by one and holds the last two, a strip, with labels numbered densely in order of appearance.
class SectionWindow {
public:
    /// Throws Error(kInput) for a volume without a cell, or with more than kMostSectionSamples in a section.
    SectionWindow(SectionReader& reader, LabelTable& labels);

    /// Moves to the next strip; returns false at the end.
    bool advance();
    /// Reads the section above high(), for the next advance(); empty at the end. Does not touch the strip, which
    /// another thread may be reading.
    std::span<const Label> read_ahead();

    std::span<const Label> low() const { return low_; }
    std::span<const Label> high() const { return high_; }
    /// Up to high().
    std::uint32_t sections_read() const { return sections_read_; }
    bool is_last() const { return sections_read_ == reader_.section_count(); }

private:
    bool move_up();

    SectionReader& reader_;
    LabelTable& labels_;
    std::vector<InputLabel> input_;
    std::vector<Label> low_, high_, ahead_;
    bool is_ahead_ = false;  // ahead_ has a section
    std::uint32_t sections_read_ = 0;
};

}  // namespace regionmesh
