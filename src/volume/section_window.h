// Two consecutive sections with dense labels.
#pragma once

#include <span>
#include <vector>

#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Pulls sections and hands out strips: the last two sections, numbered densely by a table that grows as it reads.
class SectionWindow {
public:
    /// Throws Error(kInput) when the volume has no cell, or sections too large for the tables.
    SectionWindow(SectionReader& reader, LabelTable& labels);

    /// Reads on to the next strip; false when there is none.
    bool advance();

    std::span<const Label> low() const { return low_; }
    std::span<const Label> high() const { return high_; }
    std::uint32_t sections_read() const { return sections_read_; }
    bool is_last() const { return sections_read_ == reader_.section_count(); }

private:
    bool read();

    SectionReader& reader_;
    LabelTable& labels_;
    std::vector<InputLabel> input_;
    std::vector<Label> low_, high_;
    std::uint32_t sections_read_ = 0;
};

}  // namespace regionmesh
