#include "volume/between_reader.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "regionmesh/error.h"

namespace regionmesh {

Gap gap_of(const VolumeInfo& info, std::uint32_t between) {
    const auto [u, v, w] = info.sweep.axes;
    const Vec3& spacing = info.lattice.spacing;
    const double finest = std::min(spacing[u], spacing[v]);
    return {.width = static_cast<std::int32_t>(info.lattice.size[u]),
            .height = static_cast<std::int32_t>(info.lattice.size[v]),
            .steps = between + 1,
            .step = {static_cast<float>(spacing[u] / finest), static_cast<float>(spacing[v] / finest)},
            .distance = static_cast<float>(spacing[w] / finest)};
}

BetweenReader::BetweenReader(std::unique_ptr<SectionReader> reader, std::uint32_t between, std::uint32_t threads)
    : reader_(std::move(reader)), info_(reader_->info()), gap_(gap_of(info_, between)), filler_(threads) {
    const auto axis = static_cast<std::size_t>(info_.sweep.axes[2]);
    const std::uint64_t sections = std::uint64_t{reader_->section_count() - 1} * gap_.steps + 1;
    if (gap_.samples() * (gap_.steps + 1) >= std::numeric_limits<std::uint32_t>::max() ||
        sections > std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorCode::kUsage, "--between " + std::to_string(between) + ": " + info_.source +
                                           " gets too many samples; give a smaller number, or off");
    info_.lattice.size[axis] = static_cast<std::uint32_t>(sections);
    Vec3& spacing = info_.lattice.spacing;
    (axis == 0 ? spacing.x : axis == 1 ? spacing.y : spacing.z) /= gap_.steps;
    info_.can_sweep = {axis == 0, axis == 1, axis == 2};
    info_.held_bytes += GapFiller::bytes(gap_);
}

void BetweenReader::read(std::vector<InputLabel>& section) {
    section.resize(gap_.samples());
    require_section(reader_->next(section), reader_->info(), read_);
    ++read_;
}

bool BetweenReader::next(std::span<InputLabel> section) {
    if (section_ == section_count()) return false;
    const std::uint32_t step = section_ % gap_.steps;
    if (section_ == 0) read(low_);
    if (step == 0) {
        if (section_ > 0) std::swap(low_, high_);
        std::ranges::copy(low_, section.begin());
    } else {
        if (step == 1) {
            read(high_);
            filler_.fill(gap_, low_, high_);
        }
        filler_.copy(step - 1, section);
    }
    ++section_;
    return true;
}

void BetweenReader::rewind() {
    reader_->rewind();
    section_ = read_ = 0;
}

}  // namespace regionmesh
