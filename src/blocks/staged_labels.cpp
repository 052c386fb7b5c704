#include "blocks/staged_labels.h"

namespace regionmesh {
namespace {

class Rows final : public BoxSections {
public:
    Rows(const formats::InputFile& file, const Lattice& lattice, const Sweep& sweep, const IndexBox& box)
        : file_(file), lattice_(lattice), sweep_(sweep), box_(box), next_(box.low[sweep.axes[2]]) {}

    void next(std::span<Label> section) override {
        const int u = sweep_.axes[0], v = sweep_.axes[1];
        const std::uint64_t width = lattice_.size[u], height = lattice_.size[v];
        const std::array<std::uint32_t, 3> size = box_.size();
        const bool is_whole_width = size[u] == width;
        const std::uint32_t reads = is_whole_width ? 1 : size[v];
        const std::size_t count = is_whole_width ? section.size() : size[u];
        for (std::uint32_t row = 0; row < reads; ++row) {
            const std::uint64_t first = (next_ * height + box_.low[v] + row) * width + box_.low[u];
            const auto bytes = std::as_writable_bytes(section.subspan(row * count, count));
            if (file_.read(first * sizeof(Label), bytes) != bytes.size())
                formats::fail_section(file_.path(), next_, "the file ends early; remove it, and run again");
        }
        ++next_;
    }

private:
    const formats::InputFile& file_;
    const Lattice& lattice_;
    const Sweep& sweep_;
    IndexBox box_;
    std::uint64_t next_;
};

}  // namespace

StagedLabels::StagedLabels(const std::filesystem::path& path, const Lattice& lattice, const Sweep& sweep)
    : file_(path), lattice_(lattice), sweep_(sweep) {
    const std::uint64_t samples = std::uint64_t{lattice.size[0]} * lattice.size[1] * lattice.size[2];
    if (file_.size() != samples * sizeof(Label))
        formats::fail(path, std::to_string(file_.size()) + " bytes instead of " +
                                std::to_string(samples * sizeof(Label)) + "; remove the file, and run again");
}

std::unique_ptr<BoxSections> StagedLabels::open(const IndexBox& box) const {
    return std::make_unique<Rows>(file_, lattice_, sweep_, box);
}

StagedReader::StagedReader(const StagedLabels& staged, const LabelTable& labels, const VolumeInfo& info)
    : staged_(staged), labels_(labels), info_(info), box_{{}, info.lattice.size}, sections_(staged.open(box_)) {}

bool StagedReader::next(std::span<InputLabel> section) {
    if (next_ == section_count()) return false;
    section_.resize(section.size());
    sections_->next(section_);
    for (std::size_t n = 0; n < section.size(); ++n) {
        if (section_[n] >= labels_.size())
            formats::fail_section(staged_.path(), next_, "has a label that is not there; remove it, and run again");
        section[n] = labels_.input(section_[n]);
    }
    ++next_;
    return true;
}

void StagedReader::rewind() {
    sections_ = staged_.open(box_);
    next_ = 0;
}

bool StagedReader::crop(const IndexBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box_.high[axis] = box_.low[axis] + box.high[axis];
        box_.low[axis] += box.low[axis];
    }
    info_.lattice = cropped(info_.lattice, box);
    rewind();
    return true;
}

}  // namespace regionmesh
