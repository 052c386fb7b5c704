#include "support/volumes.h"

#include <cassert>

#include "base/hash.h"
#include "regionmesh/array_sections.h"

namespace regionmesh::test {
namespace {

/// The samples in the order in which they are kept.
template <class Label>
ArrayVolume volume_of(Size size, Label&& label) {
    std::vector<InputLabel> labels;
    labels.reserve(std::size_t{size[0]} * size[1] * size[2]);
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            for (std::uint32_t x = 0; x < size[0]; ++x) labels.push_back(label(x, y, z));
    return {size, std::move(labels)};
}

double distance2(Vec3 a, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return length2(a - Vec3{double(x), double(y), double(z)});
}

}  // namespace

ArrayVolume::ArrayVolume(Size size, std::vector<InputLabel> labels) : labels_(std::move(labels)) {
    assert(labels_.size() == std::size_t{size[0]} * size[1] * size[2]);
    info_.source = "memory";
    info_.format = "memory";
    info_.type = SampleType::kI64;
    info_.lattice.size = size;
}

InputLabel ArrayVolume::at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return labels_[(std::size_t{z} * size()[1] + y) * size()[0] + x];
}

bool ArrayVolume::next(std::span<InputLabel> section) {
    constexpr std::array kChoices{SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};
    if (!reader_) reader_ = open_array(label_array(labels_.data(), size()), {.sweep = kChoices[info_.sweep.axes[2]]});
    return reader_->next(section);
}

ArrayVolume& ArrayVolume::swept(Sweep sweep) {
    info_.sweep = sweep;
    reader_.reset();
    return *this;
}

ArrayVolume& ArrayVolume::spaced(Vec3 spacing) {
    info_.lattice.spacing = spacing;
    return *this;
}

ArrayVolume& ArrayVolume::once() {
    info_.can_rewind = false;
    return *this;
}

ArrayVolume& ArrayVolume::unsigned_labels() {
    info_.type = SampleType::kU64;
    return *this;
}

TextVolume::TextVolume(const std::vector<Section>& sections)
    : ArrayVolume(
          volume_of({static_cast<std::uint32_t>(sections[0][0].size()), static_cast<std::uint32_t>(sections[0].size()),
                     static_cast<std::uint32_t>(sections.size())},
                    [&](auto x, auto y, auto z) {
                        const char c = sections[z][y].at(x);
                        return InputLabel{c <= '9' ? c - '0' : c - 'a' + 10};
                    })) {}

ArrayVolume solid_volume(Size size, InputLabel label) {
    return volume_of(size, [&](auto, auto, auto) { return label; });
}

ArrayVolume noise_volume(Size size, std::uint32_t label_count, std::uint64_t seed, InputLabel first) {
    std::uint64_t state = mix64(seed);
    return volume_of(
        size, [&](auto, auto, auto) { return first + static_cast<InputLabel>((state = mix64(state)) % label_count); });
}

ArrayVolume grain_volume(Size size, std::uint32_t label_count, std::uint64_t seed, InputLabel first) {
    std::uint64_t state = mix64(seed);
    const auto unit = [&] { return static_cast<double>((state = mix64(state)) >> 11) * 0x1p-53; };
    std::vector<Vec3> points(label_count);
    for (Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) p[axis] = unit() * (size[axis] - 1);
    return volume_of(size, [&](auto x, auto y, auto z) {
        std::uint32_t nearest = 0;
        for (std::uint32_t n = 1; n < label_count; ++n)
            if (distance2(points[n], x, y, z) < distance2(points[nearest], x, y, z)) nearest = n;
        return first + InputLabel{nearest};
    });
}

ArrayVolume grain_blocks(std::uint32_t side, std::uint32_t count) {
    const ArrayVolume block = grain_volume({side, side, side}, side / 2, 6);
    return volume_of({side, side, side * count}, [&](auto x, auto y, auto z) {
        const std::uint32_t at = z % side;
        return block.at(x, y, z / side % 2 ? side - 1 - at : at);
    });
}

ArrayVolume ball_volume(Size size, double radius) {
    const Vec3 middle = 0.5 * Vec3{size[0] - 1.0, size[1] - 1.0, size[2] - 1.0};
    return volume_of(size, [&](auto x, auto y, auto z) {
        return InputLabel{distance2(middle, x, y, z) <= radius * radius ? 1 : 0};
    });
}

}  // namespace regionmesh::test
