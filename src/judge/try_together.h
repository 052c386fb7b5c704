// Changes that are tested at the same time and made one after the other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box.h"
#include "base/parallel_for.h"
#include "judge/tuning.h"

namespace regionmesh {

/// Calls test(n) for all trials, on at most `threads` threads at a time (0: one per core), and then settle(n), in order
/// and on this thread, which returns whether it changed the mesh. A test does not change the mesh. It sets `box` of its
/// trial, round all that a change must not touch if the test is to hold, and round all that settle(n) would change: the
/// vertices of the faces, before and after. Trials whose boxes meet that of an earlier one that changed the mesh are
/// left out: settle() is not called for them. The outcome does not depend on the threads.
template <class Trial, class Test, class Settle>
void try_together(std::span<Trial> trials, std::uint32_t threads, Test&& test, Settle&& settle) {
    const auto count = static_cast<std::uint32_t>(trials.size());
    if (count == 1) {
        test(0);
        settle(0);
        return;
    }
    parallel_for(count, threads, [&](std::uint32_t n) { test(n); });
    std::vector<const Box*> changed;
    for (std::uint32_t n = 0; n < count; ++n) {
        const Box& box = trials[n].box;
        if (std::ranges::any_of(changed, [&](const Box* other) { return overlap(*other, box); })) continue;
        if (settle(n)) changed.push_back(&box);
    }
}

/// Stripes into which so many trials are parted.
inline std::uint32_t stripe_count(std::uint32_t size) { return std::clamp(size / kLeastOfStripe, 1u, kMostStripes); }

/// The same for the numbers below `size`, which are parted into stripes (stripe_count). The next numbers of all
/// stripes are tried together: they lie far apart where the numbers follow a curve. A number that is left out is tried
/// again with the next ones. Calls test(number, trial) and settle(number, trial); trials begin as copies of `first`.
template <class Trial, class Test, class Settle>
void try_in_stripes(std::uint32_t size, std::uint32_t threads, const Trial& first, Test&& test, Settle&& settle) {
    struct Stripe {
        std::uint32_t at, end;
    };
    const std::uint32_t count = stripe_count(size);
    const auto begin_of = [&](std::uint64_t n) { return static_cast<std::uint32_t>(n * size / count); };
    std::vector<Stripe> stripes;
    for (std::uint32_t n = 0; n < count; ++n) stripes.push_back({begin_of(n), begin_of(n + 1)});
    std::vector<Trial> trials(count, first);
    for (;;) {
        std::erase_if(stripes, [](const Stripe& stripe) { return stripe.at == stripe.end; });
        if (stripes.empty()) return;
        try_together(
            std::span(trials).first(stripes.size()), threads, [&](std::uint32_t n) { test(stripes[n].at, trials[n]); },
            [&](std::uint32_t n) { return settle(stripes[n].at++, trials[n]); });
    }
}

}  // namespace regionmesh
