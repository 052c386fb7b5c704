// Copies boxes of samples between arrays with different orders of axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace regionmesh::formats {

/// Bytes from one sample to the next along x, y and z; 0 repeats one sample.
using Pitches = std::array<std::uint64_t, 3>;

template <class Byte>
struct Strided {
    Byte* first;  // sample
    Pitches pitch;
};

/// Copies `count` samples along x, y and z, of 1, 2, 4 or 8 bytes each. Needs no alignment.
void copy_box(Strided<const std::byte> from, Strided<std::byte> to, const std::array<std::uint64_t, 3>& count,
              std::size_t sample_bytes);

}  // namespace regionmesh::formats
