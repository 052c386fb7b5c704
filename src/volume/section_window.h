// Two consecutive sections with dense labels.
#pragma once

#include <span>
#include <vector>

#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Reads sections and provides strips: the last two sections, with dense labels from a table that grows on reading.
class SectionWindow {
public:
    /// Throws Error(kInput) if the volume has no cell, or if a section has more than 7e8 samples.
    SectionWindow(SectionReader& reader, LabelTable& labels);

    /// Reads the next strip; false after the last.
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
