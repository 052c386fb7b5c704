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

}  // namespace regionmesh::formats
