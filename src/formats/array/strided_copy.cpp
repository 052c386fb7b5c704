#include "formats/array/strided_copy.h"

#include <cassert>
#include <cstring>
#include <utility>

namespace regionmesh::formats {
namespace {

template <std::size_t kBytes>
void copy_run(const std::byte* from, std::uint64_t from_pitch, std::byte* to, std::uint64_t to_pitch,
              std::uint64_t count) {
    if (from_pitch == kBytes && to_pitch == kBytes) {
        std::memcpy(to, from, count * kBytes);
        return;
    }
    for (; count > 0; --count, from += from_pitch, to += to_pitch) std::memcpy(to, from, kBytes);
}

template <std::size_t kBytes>
void copy_runs(Strided<const std::byte> from, Strided<std::byte> to, const std::array<std::uint64_t, 3>& count,
               const std::array<int, 3>& order) {
    const auto [inner, middle, outer] = order;
    for (std::uint64_t i = 0; i < count[outer]; ++i) {
        const std::byte* source = from.first + i * from.pitch[outer];
        std::byte* target = to.first + i * to.pitch[outer];
        for (std::uint64_t j = 0; j < count[middle]; ++j) {
            copy_run<kBytes>(source + j * from.pitch[middle], from.pitch[inner], target + j * to.pitch[middle],
                             to.pitch[inner], count[inner]);
        }
    }
}

}  // namespace

void copy_box(Strided<const std::byte> from, Strided<std::byte> to, const std::array<std::uint64_t, 3>& count,
              std::size_t sample_bytes) {
    // Runs follow the axis with the smallest pitch in the target.
    std::array<int, 3> order{0, 1, 2};
    const auto sort = [&](int a, int b) {
        if (to.pitch[order[a]] > to.pitch[order[b]]) std::swap(order[a], order[b]);
    };
    sort(0, 1);
    sort(1, 2);
    sort(0, 1);
    switch (sample_bytes) {
        case 1:
            return copy_runs<1>(from, to, count, order);
        case 2:
            return copy_runs<2>(from, to, count, order);
        case 4:
            return copy_runs<4>(from, to, count, order);
        case 8:
            return copy_runs<8>(from, to, count, order);
    }
    assert(false);
}

}  // namespace regionmesh::formats
