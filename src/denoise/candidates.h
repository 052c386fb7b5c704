// Samples that a smoother surface would give another label.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/temporary_file.h"
#include "regionmesh/label.h"

namespace regionmesh {

/// A sample of a section, by number, and its other label.
struct Candidate {
    std::uint32_t sample;
    Label to;
};

/// A sample of a section that changed.
struct SampleChange {
    std::uint64_t sample;
    InputLabel to;
};

/// Items of each section in a temporary file: written in the order of sections, read in any.
template <class Item>
class ItemsBySection {
public:
    void append(std::span<const Item> items) {
        file_.append_items(items);
        ends_.push_back(file_.size());
    }
    void read(std::uint32_t section, std::vector<Item>& items) const {
        const std::uint64_t first = section == 0 ? 0 : ends_[section - 1];
        file_.read_items(first, (ends_[section] - first) / sizeof(Item), items);
    }
    std::uint32_t sections() const { return static_cast<std::uint32_t>(ends_.size()); }

private:
    TemporaryFile file_;
    std::vector<std::uint64_t> ends_;
};

}  // namespace regionmesh
