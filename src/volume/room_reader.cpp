#include "volume/room_reader.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/option_range.h"
#include "base/parallel_for.h"
#include "regionmesh/select_sections.h"

namespace regionmesh {
namespace {

/// The kernel ends at this number of standard deviations.
constexpr double kCutOff = 2;

}  // namespace

void require_room(double room) { require_number("room", room, kRoomRange); }

RoomReader::RoomReader(SectionReader& reader, double room, std::uint32_t threads)
    : reader_(reader), info_(reader.info()), threads_(threads) {
    make_offsets(room);
    const std::uint64_t section_bytes = std::uint64_t{section_width()} * section_height() * sizeof(InputLabel);
    info_.held_bytes = std::max(info_.held_bytes, section_bytes) + (2 * reach_ + 2) * section_bytes;
}

RoomReader::RoomReader(std::unique_ptr<SectionReader> reader, double room, std::uint32_t threads)
    : RoomReader(*reader, room, threads) {
    own_ = std::move(reader);
}

void RoomReader::make_offsets(double room) {
    const Vec3 spacing = info_.lattice.spacing;
    const auto& axes = info_.sweep.axes;
    const double finest = std::min({spacing.x, spacing.y, spacing.z});
    const Vec3 step = Vec3{spacing[axes[0]], spacing[axes[1]], spacing[axes[2]]} / finest;
    const double radius = kCutOff * room;
    const auto reach = [&](double size) { return static_cast<std::int32_t>(std::floor(radius / size)); };
    reach_ = reach(step.z);
    for (std::int32_t k = -reach_; k <= reach_; ++k)
        for (std::int32_t j = -reach(step.y); j <= reach(step.y); ++j)
            for (std::int32_t i = -reach(step.x); i <= reach(step.x); ++i) {
                const double far = length({i * step.x, j * step.y, k * step.z});
                if (far > radius) continue;
                const Offset offset{i, j, k, static_cast<float>(std::exp(-far * far / (2 * room * room)))};
                kernel_.push_back(offset);
                const int steps = std::max({std::abs(i), std::abs(j), std::abs(k)});
                if (steps > 0 && far * (1 - 0.5 / steps) < room) near_.push_back(offset);
            }
    // The sample itself first; the order decides how weights are summed.
    std::stable_sort(kernel_.begin(), kernel_.end(),
                     [](const Offset& a, const Offset& b) { return a.weight > b.weight; });
    std::stable_sort(near_.begin(), near_.end(), [](const Offset& a, const Offset& b) { return a.weight > b.weight; });
}

void RoomReader::rewind() {
    reader_.rewind();
    held_.clear();
    first_held_ = section_ = 0;
    changed_ = 0;
}

void RoomReader::read_ahead() {
    const std::int64_t end = std::min<std::int64_t>(section_count(), section_ + reach_ + 1);
    while (first_held_ + static_cast<std::int64_t>(held_.size()) < end) {
        std::vector<InputLabel> section(std::size_t{section_width()} * section_height());
        const auto number = first_held_ + static_cast<std::int64_t>(held_.size());
        require_section(reader_.next(section), info_, static_cast<std::uint32_t>(number));
        held_.push_back(std::move(section));
    }
    for (; first_held_ < section_ - reach_; ++first_held_) held_.pop_front();
}

bool RoomReader::next(std::span<InputLabel> section) {
    if (section_ == section_count()) return false;
    read_ahead();
    std::vector<std::uint64_t> changed(section_height());
    parallel_for(section_height(), threads_, [&](std::uint32_t row) {
        changed[row] = clean_row(row, section.subspan(std::size_t{row} * section_width(), section_width()));
    });
    changed_ = std::accumulate(changed.begin(), changed.end(), changed_);
    ++section_;
    return true;
}

const InputLabel* RoomReader::neighbour(std::int32_t i, std::int32_t j, const Offset& offset) const {
    const std::int64_t x = std::int64_t{i} + offset.i, y = std::int64_t{j} + offset.j, s = section_ + offset.section;
    const bool is_inside = x >= 0 && x < section_width() && y >= 0 && y < section_height() && s >= first_held_ &&
                           s < first_held_ + static_cast<std::int64_t>(held_.size());
    return is_inside ? &held_[s - first_held_][y * section_width() + x] : nullptr;
}

std::uint64_t RoomReader::clean_row(std::uint32_t row, std::span<InputLabel> out) const {
    const InputLabel* own = &held_[section_ - first_held_][std::size_t{row} * section_width()];
    std::uint64_t changed = 0;
    Weights weights;
    for (std::uint32_t i = 0; i < out.size(); ++i) {
        const auto is_other = [&](const Offset& offset) {
            const InputLabel* label = neighbour(i, row, offset);
            return label && *label != own[i];
        };
        out[i] = std::any_of(near_.begin(), near_.end(), is_other) ? cleaned(i, row, weights) : own[i];
        changed += out[i] != own[i];
    }
    return changed;
}

/// The label with most weight.
InputLabel RoomReader::cleaned(std::int32_t i, std::int32_t j, Weights& weights) const {
    weights.clear();
    for (const Offset& offset : kernel_) {
        const InputLabel* label = neighbour(i, j, offset);
        if (!label) continue;
        const auto known = std::ranges::find(weights, *label, &Weights::value_type::first);
        if (known == weights.end())
            weights.emplace_back(*label, offset.weight);
        else
            known->second += offset.weight;
    }
    const InputLabel own = weights.front().first;
    const InputLabelOrder is_before{info_.type == SampleType::kU64};
    auto best = weights.front();
    for (const auto& other : weights)
        if (other.second > best.second ||
            (other.second == best.second && best.first != own && is_before(other.first, best.first)))
            best = other;
    return best.first;
}

std::unique_ptr<SectionReader> clean_sections(std::unique_ptr<SectionReader> reader, double room,
                                              std::uint32_t threads) {
    require_room(room);
    if (room == 0) return reader;
    return std::make_unique<RoomReader>(std::move(reader), room, threads);
}

}  // namespace regionmesh
