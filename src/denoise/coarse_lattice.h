// The coarser lattice that enlarged labels were copied from.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "regionmesh/denoise.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Samples of both lattices along one axis of the sweep. Fine samples beyond the first or the last coarse one lie as if
/// they were there.
struct CoarseAxis {
    double factor = 1, first_edge = -0.5;
    std::uint32_t fine = 0;                         // samples
    std::vector<std::uint32_t> from = {};           // fine sample that each coarse one is read from
    std::vector<std::uint32_t> first_in_cell = {};  // of the fine samples from coarse sample n to n + 1; and their end

    CoarseAxis(double factor, double first_edge, std::uint32_t fine);
    std::uint32_t size() const { return static_cast<std::uint32_t>(from.size()); }
    /// Place of a fine sample in coarse samples.
    double place(std::uint32_t sample) const {
        return std::clamp((sample - first_edge) / factor - 0.5, 0.0, size() - 1.0);
    }
};

/// By axis of the sweep.
std::array<CoarseAxis, 3> coarse_axes(const VolumeInfo& info, const Roughness& roughness);

/// The coarse samples, read from the fine ones. Holds a reference to the reader.
class CoarseSections final : public SectionReader {
public:
    CoarseSections(SectionReader& reader, const std::array<CoarseAxis, 3>& axes);
    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override;

private:
    SectionReader& reader_;
    const std::array<CoarseAxis, 3>& axes_;
    VolumeInfo info_;
    std::vector<InputLabel> fine_;
    std::uint32_t read_ = 0, section_ = 0;
};

}  // namespace regionmesh
