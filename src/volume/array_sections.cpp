#include "regionmesh/array_sections.h"

#include <cmath>
#include <cstring>
#include <string>

#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "volume/choose_sweep.h"

namespace regionmesh {
namespace {

/// Copies one section, samples of type T, into 64-bit labels.
template <class T>
void copy_section(const std::byte* first, const std::array<std::uint32_t, 2>& size,
                  const std::array<std::ptrdiff_t, 2>& strides, InputLabel* to) {
    for (std::uint32_t row = 0; row < size[1]; ++row) {
        const std::byte* from = first + strides[1] * std::ptrdiff_t{row};
        for (std::uint32_t n = 0; n < size[0]; ++n, from += strides[0]) {
            T sample;
            std::memcpy(&sample, from, sizeof sample);
            *to++ = static_cast<InputLabel>(sample);
        }
    }
}

using CopySection = void (*)(const std::byte*, const std::array<std::uint32_t, 2>&,
                             const std::array<std::ptrdiff_t, 2>&, InputLabel*);

/// Null for a type that is no integer of whole bytes.
CopySection copy_of(SampleType type) {
    switch (type) {
        case SampleType::kI8:
            return copy_section<std::int8_t>;
        case SampleType::kU8:
            return copy_section<std::uint8_t>;
        case SampleType::kI16:
            return copy_section<std::int16_t>;
        case SampleType::kU16:
            return copy_section<std::uint16_t>;
        case SampleType::kI32:
            return copy_section<std::int32_t>;
        case SampleType::kU32:
            return copy_section<std::uint32_t>;
        case SampleType::kI64:
            return copy_section<std::int64_t>;
        case SampleType::kU64:
            return copy_section<std::uint64_t>;
        case SampleType::kU1:
            break;
    }
    return nullptr;
}

class ArraySections : public SectionReader {
public:
    ArraySections(const LabelArray& array, VolumeInfo info)
        : array_(array), info_(std::move(info)), copy_(copy_of(array.type)) {}

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        if (section_ == section_count()) return false;
        require_section_size(info_.source, section.size(), section_width(), section_height());
        const auto& [u, v, w] = info_.sweep.axes;
        const auto* first =
            static_cast<const std::byte*>(array_.data) + array_.strides[w] * static_cast<std::ptrdiff_t>(section_++);
        copy_(first, {array_.size[u], array_.size[v]}, {array_.strides[u], array_.strides[v]}, section.data());
        return true;
    }

    void rewind() override { section_ = 0; }

private:
    LabelArray array_;
    VolumeInfo info_;
    CopySection copy_;
    std::uint32_t section_ = 0;
};

void require_usable(const LabelArray& array, const ArrayOptions& options) {
    const auto refuse = [&](const std::string& text) { throw Error(ErrorCode::kInput, options.name + ": " + text); };
    const auto& [x, y, z] = array.size;
    if (x == 0 || y == 0 || z == 0)
        refuse("size is " + std::to_string(x) + " x " + std::to_string(y) + " x " + std::to_string(z) +
               "; give an array with samples");
    if (!array.data) refuse("no data; give the address of the first sample");
    if (!copy_of(array.type)) refuse("samples are single bits; give an array of 8, 16, 32 or 64-bit integers");
    if (options.metres && !is_unit_of_length(*options.metres))
        refuse("metres are out of range; give 1e-15 to 1e6 for a unit of length");
    for (const double entry : options.direction)
        if (!std::isfinite(entry)) refuse("direction is not finite; give nine numbers");
}

}  // namespace

std::unique_ptr<SectionReader> open_array(const LabelArray& array, const ArrayOptions& options) {
    require_usable(array, options);
    VolumeInfo info{.source = options.name,
                    .format = "array",
                    .type = array.type,
                    .can_sweep = {true, true, true},
                    .space = options.space,
                    .metres = options.metres,
                    .names = options.names};
    info.lattice = {array.size, options.spacing, options.origin, options.direction};
    require_lattice(options.name, info.lattice);
    info.sweep = *choose_sweep(info, options.sweep);
    return std::make_unique<ArraySections>(array, std::move(info));
}

}  // namespace regionmesh
