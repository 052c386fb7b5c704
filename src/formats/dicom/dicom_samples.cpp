#include "formats/dicom/dicom_samples.h"

#include <bit>
#include <cassert>
#include <cstring>

namespace regionmesh::formats {

void set_label(std::span<const std::byte> packed, InputLabel label, std::span<InputLabel> section) {
    for (std::size_t b = 0; b < packed.size(); ++b) {
        for (unsigned bits = std::to_integer<unsigned>(packed[b]); bits != 0; bits &= bits - 1) {
            const std::size_t sample = 8 * b + static_cast<std::size_t>(std::countr_zero(bits));
            if (sample < section.size()) section[sample] = label;
        }
    }
}

void copy_labels(std::span<const std::byte> stored, std::uint32_t bits, std::span<InputLabel> section) {
    const std::size_t bytes = bits / 8;
    assert(stored.size() == section.size() * bytes);
    for (std::size_t i = 0; i < section.size(); ++i) {
        std::uint16_t label = std::to_integer<std::uint16_t>(stored[i * bytes]);
        if (bits == 16) std::memcpy(&label, &stored[i * bytes], sizeof label);
        section[i] = label;
    }
}

}  // namespace regionmesh::formats
