#include "denoise/coarse_lattice.h"

#include <algorithm>
#include <cmath>

namespace regionmesh {

CoarseAxis::CoarseAxis(double f, double edge, std::uint32_t samples) : factor(f), first_edge(edge), fine(samples) {
    const double last = fine - 1.0;
    for (std::int64_t n = 0;; ++n) {
        const double low = first_edge + static_cast<double>(n) * factor;
        if (low >= last) break;
        const double middle = std::clamp(low + factor / 2, 0.0, last);
        auto sample = static_cast<std::uint32_t>(std::lround(middle));
        // A part of a coarse sample at the end may be nearer to a fine sample beside it.
        if (sample <= low) ++sample;
        from.push_back(std::min(sample, fine - 1));
    }
    first_in_cell.assign(from.size(), fine);
    for (std::uint32_t i = fine; i-- > 0;) {
        const auto cell = static_cast<std::size_t>(std::clamp(std::floor(place(i)), 0.0, size() - 2.0));
        first_in_cell[cell] = i;
    }
    for (std::size_t n = first_in_cell.size() - 1; n-- > 0;)
        first_in_cell[n] = std::min(first_in_cell[n], first_in_cell[n + 1]);
}

std::array<CoarseAxis, 3> coarse_axes(const VolumeInfo& info, const Roughness& roughness) {
    const auto axis = [&](std::size_t n) {
        const auto a = static_cast<std::size_t>(info.sweep.axes[n]);
        const double factor = roughness.enlarged[a];
        return CoarseAxis(factor, factor > 1 ? roughness.first_edge[a] : -0.5, info.lattice.size[a]);
    };
    return {axis(0), axis(1), axis(2)};
}

CoarseSections::CoarseSections(SectionReader& reader, const std::array<CoarseAxis, 3>& axes)
    : reader_(reader),
      axes_(axes),
      info_(reader.info()),
      fine_(std::size_t{reader.section_width()} * reader.section_height()) {
    for (std::size_t n = 0; n < 3; ++n) {
        const int axis = info_.sweep.axes[n];
        info_.lattice.size[static_cast<std::size_t>(axis)] = axes[n].size();
        info_.lattice.spacing[axis] *= axes[n].factor;
    }
    info_.lattice.origin = {};
    info_.lattice.direction = Lattice().direction;
}

bool CoarseSections::next(std::span<InputLabel> section) {
    if (section_ == section_count()) return false;
    for (; read_ <= axes_[2].from[section_]; ++read_) require_section(reader_.next(fine_), reader_.info(), read_);
    std::size_t to = 0;
    for (const std::uint32_t j : axes_[1].from)
        for (const std::uint32_t i : axes_[0].from) section[to++] = fine_[std::size_t{j} * axes_[0].fine + i];
    ++section_;
    return true;
}

void CoarseSections::rewind() {
    reader_.rewind();
    read_ = section_ = 0;
}

}  // namespace regionmesh
