#include "volume/section_window.h"

#include "regionmesh/error.h"
#include "regionmesh/limits.h"

namespace regionmesh {

void require_cells(const VolumeInfo& info) {
    require_sweep(info.source, info.sweep);
    for (int axis = 0; axis < 3; ++axis)
        if (info.lattice.size[axis] < 2)
            throw Error(ErrorCode::kInput, info.source + ": " + std::to_string(info.lattice.size[axis]) +
                                               " sample along " + "xyz"[axis] +
                                               "; a cell needs two. Two equal sections make a plate, one spacing "
                                               "thick");
}

void require_section(bool is_there, const VolumeInfo& info, std::uint32_t section) {
    if (is_there) return;
    throw Error(ErrorCode::kInput, info.source + ": section " + std::to_string(section) + " is missing; " +
                                       std::to_string(info.lattice.size[info.sweep.axes[2]]) +
                                       " sections were announced, give as many");
}

void require_section_size(const std::string& what, std::size_t labels, std::uint32_t width, std::uint32_t height) {
    if (labels == std::size_t{width} * height) return;
    throw Error(ErrorCode::kUsage, what + ": room for " + std::to_string(labels) + " labels of a section of " +
                                       std::to_string(width) + " x " + std::to_string(height) +
                                       "; give as much as it has samples");
}

SectionWindow::SectionWindow(SectionReader& reader, LabelTable& labels) : reader_(reader), labels_(labels) {
    const VolumeInfo& info = reader.info();
    require_cells(info);
    const std::size_t samples = std::size_t{reader.section_width()} * reader.section_height();
    if (samples > kMostSectionSamples)
        throw Error(ErrorCode::kInput, info.source + ": a section of " + std::to_string(samples) +
                                           " samples is more than " + std::to_string(kMostSectionSamples) +
                                           "; choose another --sweep");
    input_.resize(samples);
    low_.resize(samples);
    high_.resize(samples);
}

bool SectionWindow::move_up() {
    if (is_last()) return false;
    if (!is_ahead_) require_section(reader_.next(input_), reader_.info(), sections_read_);
    low_.swap(high_);
    if (is_ahead_)
        high_.swap(ahead_);
    else
        labels_.dense(input_, high_);
    is_ahead_ = false;
    ++sections_read_;
    return true;
}

bool SectionWindow::advance() {
    if (sections_read_ == 0 && !move_up()) return false;
    return move_up();
}

std::span<const Label> SectionWindow::read_ahead() {
    if (!is_ahead_) {
        if (is_last()) return {};
        require_section(reader_.next(input_), reader_.info(), sections_read_);
        ahead_.resize(input_.size());
        labels_.dense(input_, ahead_);
        is_ahead_ = true;
    }
    return ahead_;
}

}  // namespace regionmesh
