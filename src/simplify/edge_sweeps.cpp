#include "simplify/edge_sweeps.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "simplify/tuning.h"

namespace regionmesh {
namespace {

/// Numbers have the order of the keys, negative ones included.
std::uint32_t number_of(float key) {
    const auto bits = std::bit_cast<std::uint32_t>(key);
    return bits ^ ((bits >> 31) != 0 ? 0xFFFFFFFFu : 0x80000000u);
}

float key_of(std::uint32_t number) {
    return std::bit_cast<float>(number ^ ((number >> 31) != 0 ? 0x80000000u : 0xFFFFFFFFu));
}

}  // namespace

void EdgeSweeps::find_next(std::uint64_t wanted) {
    for (;; ++at_) {
        if (at_ == keys_.size()) {
            at_ = 0;
            const std::uint64_t least = size_ / kLeastSweepPart + 1, most = size_ / kMostSweepPart + 1;
            limit_ = least_key(std::clamp(wanted, least, most));
        }
        if (keys_[at_] <= limit_) return;
    }
}

/// The key in this place by cost, counted from 1. Counts the digits of 16 bits twice, without a copy of the keys.
float EdgeSweeps::least_key(std::uint64_t rank) const {
    std::vector<std::uint32_t> counts(1u << 16);
    const auto digit_at_rank = [&] {
        std::uint32_t digit = 0;
        for (; counts[digit] < rank; ++digit) rank -= counts[digit];
        return digit;
    };
    for (const float key : keys_) ++counts[number_of(key) >> 16];
    const std::uint32_t high = digit_at_rank();
    std::ranges::fill(counts, 0);
    for (const float key : keys_)
        if (number_of(key) >> 16 == high) ++counts[number_of(key) & 0xFFFF];
    return key_of(high << 16 | digit_at_rank());
}

}  // namespace regionmesh
