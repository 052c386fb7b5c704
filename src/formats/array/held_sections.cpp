#include "formats/array/held_sections.h"

#include <utility>

#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

class HeldSections final : public CroppedSections {
public:
    HeldSections(std::vector<InputLabel> labels, VolumeInfo info)
        : CroppedSections(std::move(info)), labels_(std::move(labels)), size_(info_.lattice.size) {
        info_.held_bytes = labels_.size() * sizeof(InputLabel);
    }

private:
    void plan_blocks() override {}

    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        const std::array<std::size_t, 3> pitch{1, size_[0], std::size_t{size_[0]} * size_[1]};
        const auto [u, v, w] = info_.sweep.axes;
        std::size_t corner = number * pitch[w];
        for (std::size_t axis = 0; axis < 3; ++axis) corner += box_.low[axis] * pitch[axis];
        auto to = section.begin();
        for (std::size_t row = 0; row < section_height(); ++row)
            for (std::size_t column = 0; column < section_width(); ++column)
                *to++ = labels_[corner + row * pitch[v] + column * pitch[u]];
    }

    std::vector<InputLabel> labels_;
    std::array<std::uint32_t, 3> size_;
};

}  // namespace

std::unique_ptr<SectionReader> open_held(std::vector<InputLabel> labels, VolumeInfo info, const ReadOptions& options) {
    info.can_sweep = {true, true, true};
    apply_options(info, options);
    return std::make_unique<HeldSections>(std::move(labels), std::move(info));
}

}  // namespace regionmesh::formats
