// Moves sections in their plane.
#pragma once

#include <memory>
#include <vector>

#include "regionmesh/prepare_sections.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Returns the sections of another reader, each moved back by its jitter: to the nearest sample, so that labels stay
/// labels. Samples from outside a section get the label of the nearest at its side.
class AlignReader final : public SectionReader {
public:
    /// Requires one shift for each section.
    AlignReader(std::unique_ptr<SectionReader> reader, std::vector<SectionShift> jitter);

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override;

    /// Sections that change, and the largest shift in samples: at the middle, or at the corners where it turns.
    std::uint32_t moved() const { return moved_; }
    double largest() const { return largest_; }

private:
    double reach(const SectionShift& shift) const;

    std::unique_ptr<SectionReader> reader_;
    VolumeInfo info_;
    std::vector<SectionShift> jitter_;
    std::vector<InputLabel> read_;
    std::uint32_t section_ = 0, moved_ = 0;
    double largest_ = 0;
};

}  // namespace regionmesh
