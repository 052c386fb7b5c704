#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/add_warning.h"
#include "volume/chosen_sections.h"

namespace regionmesh {
namespace {

/// Axes of one sample become axes of two equal ones.
class PlateSections final : public SectionReader {
public:
    explicit PlateSections(ReaderPointer reader)
        : reader_(std::move(reader)), info_(reader_->info()), section_(section_size(*reader_)) {
        std::string axes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (info_.lattice.size[axis] != 1) continue;
            info_.lattice.size[axis] = 2;
            axes += "xyz"[axis];
        }
        info_.can_sweep = {};
        info_.can_sweep[static_cast<std::size_t>(info_.sweep.axes[2])] = true;
        info_.held_bytes += section_.size() * sizeof(InputLabel);
        add_warning(info_.warning,
                    "it has one sample along " + axes + ", and is repeated: the model is a plate, one spacing thick");
    }

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        if (given_ == section_count()) return false;
        const bool is_repeated = given_ > 0 && reader_->section_count() == 1;
        if (!is_repeated && !reader_->next(section_)) return false;
        ++given_;
        const std::size_t width = reader_->section_width(), height = reader_->section_height();
        auto to = section.begin();
        for (std::size_t row = 0; row < section_height(); ++row)
            for (std::size_t column = 0; column < section_width(); ++column)
                *to++ = section_[std::min(row, height - 1) * width + std::min(column, width - 1)];
        return true;
    }

    void rewind() override {
        reader_->rewind();
        given_ = 0;
    }

private:
    static std::size_t section_size(const SectionReader& reader) {
        return std::size_t{reader.section_width()} * reader.section_height();
    }

    ReaderPointer reader_;
    VolumeInfo info_;
    std::vector<InputLabel> section_;  // of the reader
    std::uint32_t given_ = 0;
};

}  // namespace

ReaderPointer as_plate(ReaderPointer reader) {
    const auto& size = reader->info().lattice.size;
    const auto single = std::ranges::count(size, 1u);
    // A line or a point is no section.
    return single == 1 ? std::make_unique<PlateSections>(std::move(reader)) : std::move(reader);
}

}  // namespace regionmesh
