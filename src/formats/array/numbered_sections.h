// The part that all section readers of volumes share.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <optional>
#include <utility>

#include "formats/codec/sample_format.h"
#include "formats/input_file.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// Counts the sections; a reader defines how one is read.
class NumberedSections : public SectionReader {
public:
    const VolumeInfo& info() const final { return info_; }

    bool next(std::span<InputLabel> section) final {
        assert(section.size() == std::size_t{section_width()} * section_height());
        if (next_ == section_count()) return false;
        read_section(next_, section);
        ++next_;
        return true;
    }

    void rewind() override { next_ = 0; }

protected:
    explicit NumberedSections(VolumeInfo info) : info_(std::move(info)) {}

    /// Throws where a sample of the section is no label: that at `first` plus its index, `low` samples from the first
    /// of the file.
    void require_labels(const std::optional<NoLabel>& problem, std::uint32_t section, std::size_t first = 0,
                        const std::array<std::uint32_t, 3>& low = {}) const {
        if (!problem) return;
        const std::size_t at = first + problem->index;
        const auto& axes = info_.sweep.axes;
        std::array<std::uint64_t, 3> index{low[0], low[1], low[2]};
        index[axes[0]] += at % section_width();
        index[axes[1]] += at / section_width();
        index[axes[2]] += section;
        fail_section(info_.source, index[axes[2]],
                     fmt::format("sample ({}, {}, {}) {}", index[0], index[1], index[2], why_no_label(problem->value)));
    }

    VolumeInfo info_;

private:
    /// Called for 0, 1, 2 and so on, again from 0 after rewind(), and again with the same number after it threw.
    virtual void read_section(std::uint32_t number, std::span<InputLabel> section) = 0;

    std::uint32_t next_ = 0;
};

/// The part that readers share which reach any box of the file in blocks of sections.
class CroppedSections : public NumberedSections {
public:
    bool crop(const IndexBox& box) final {
        if (!can_crop()) return false;
        for (int axis = 0; axis < 3; ++axis) {
            box_.high[axis] = box_.low[axis] + box.high[axis];
            box_.low[axis] += box.low[axis];
        }
        info_.lattice = cropped(info_.lattice, box);
        plan_blocks();
        rewind();
        return true;
    }

protected:
    explicit CroppedSections(VolumeInfo info) : NumberedSections(std::move(info)), box_{{}, info_.lattice.size} {}

    IndexBox box_;  // of the file

private:
    virtual bool can_crop() const { return true; }
    /// Forgets the block that is held, and plans those of the box: sets info_.held_bytes.
    virtual void plan_blocks() = 0;
};

}  // namespace regionmesh::formats
