#include "volume/align_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace regionmesh {
namespace {

constexpr double kLeastShift = 0.5;  // samples: less moves none to another place

}  // namespace

AlignReader::AlignReader(std::unique_ptr<SectionReader> reader, std::vector<SectionShift> jitter)
    : reader_(std::move(reader)), info_(reader_->info()), jitter_(std::move(jitter)) {
    info_.held_bytes += std::uint64_t{section_width()} * section_height() * sizeof(InputLabel);
    for (SectionShift& shift : jitter_) {
        const double far = reach(shift);
        if (far < kLeastShift) {
            shift = {};
            continue;
        }
        ++moved_;
        largest_ = std::max(largest_, far);
    }
}

double AlignReader::reach(const SectionShift& shift) const {
    return std::hypot(shift.x, shift.y) + std::abs(shift.angle) * std::hypot(section_width(), section_height()) / 2;
}

bool AlignReader::next(std::span<InputLabel> section) {
    if (section_ == section_count()) return false;
    const SectionShift& shift = jitter_[section_];
    read_.resize(section.size());
    require_section(reader_->next(read_), info_, section_);
    ++section_;
    if (shift.x == 0 && shift.y == 0 && shift.angle == 0) {
        std::ranges::copy(read_, section.begin());
        return true;
    }
    const auto width = static_cast<std::int32_t>(section_width()), height = static_cast<std::int32_t>(section_height());
    const double c = std::cos(shift.angle), s = std::sin(shift.angle);
    const double mid_x = (width - 1) / 2.0, mid_y = (height - 1) / 2.0;
    for (std::int32_t y = 0; y < height; ++y)
        for (std::int32_t x = 0; x < width; ++x) {
            const double u = x - mid_x, v = y - mid_y;
            const auto i = static_cast<std::int32_t>(std::floor(mid_x + c * u - s * v + shift.x + 0.5));
            const auto j = static_cast<std::int32_t>(std::floor(mid_y + s * u + c * v + shift.y + 0.5));
            section[std::size_t(y) * std::size_t(width) + std::size_t(x)] =
                read_[std::size_t(std::clamp(j, 0, height - 1)) * std::size_t(width) +
                      std::size_t(std::clamp(i, 0, width - 1))];
        }
    return true;
}

void AlignReader::rewind() {
    reader_->rewind();
    section_ = 0;
}

}  // namespace regionmesh
