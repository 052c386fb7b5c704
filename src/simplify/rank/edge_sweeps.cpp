#include "simplify/rank/edge_sweeps.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "judge/try_together.h"
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
    for (;;) {
        next_.clear();
        for (Stripe& stripe : stripes_) {
            while (stripe.at < stripe.end && keys_[stripe.at] > limit_) ++stripe.at;
            if (stripe.at < stripe.end) next_.push_back(VertexId{stripe.at});
        }
        if (!next_.empty()) return;
        begin_sweep(wanted);
    }
}

void EdgeSweeps::begin_sweep(std::uint64_t wanted) {
    const std::uint64_t least = size_ / kLeastSweepPart + 1, most = size_ / kMostSweepPart + 1;
    limit_ = least_key(std::clamp(wanted, least, most));
    const std::uint32_t count = std::ranges::count_if(keys_, [&](float key) { return key <= limit_; });
    const std::uint32_t stripes = stripe_count(count);
    stripes_.clear();
    std::uint32_t first = 0, passed = 0;
    for (std::uint32_t v = 0; v < keys_.size(); ++v) {
        if (!(keys_[v] <= limit_)) continue;
        if (++passed * std::uint64_t{stripes} < count * (stripes_.size() + 1)) continue;
        stripes_.push_back({first, v + 1});
        first = v + 1;
    }
    stripes_.back().end = keys_.size();
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
