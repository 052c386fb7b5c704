// The part that all section readers of volumes share.
#pragma once

#include <cassert>
#include <utility>

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
