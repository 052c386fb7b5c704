// Puts sections between those of another reader.
#pragma once

#include <memory>
#include <vector>

#include "regionmesh/section_reader.h"
#include "volume/gap_filler.h"

namespace regionmesh {

/// The gap between two sections of a volume, with `between` new sections.
Gap gap_of(const VolumeInfo& info, std::uint32_t between);

/// Returns every section of another reader, and after each but the last `between` that are interpolated from it and the
/// next. Holds two sections and one gap.
class BetweenReader final : public SectionReader {
public:
    /// Requires between > 0. Throws Error(kUsage) where a gap has 2^32 samples or more.
    BetweenReader(std::unique_ptr<SectionReader> reader, std::uint32_t between, std::uint32_t threads);

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override;

private:
    void read(std::vector<InputLabel>& section);

    std::unique_ptr<SectionReader> reader_;
    VolumeInfo info_;
    Gap gap_;
    GapFiller filler_;
    std::vector<InputLabel> low_, high_;
    std::uint32_t section_ = 0;  // next of this reader
    std::uint32_t read_ = 0;     // sections of the other
};

}  // namespace regionmesh
