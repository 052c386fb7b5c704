// Changes that are tested at the same time and made one after the other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/box.h"
#include "base/parallel_for.h"
#include "simplify/tuning.h"

namespace regionmesh {

/// Calls test(n) for all trials, on at most `threads` threads at a time (0: one per core), and then settle(n), in order
/// and on this thread. A test looks at the mesh as it is, writes to its own trial only, and sets its `box`, in which is
/// all that could change the outcome of the test, and all that settle() changes: the vertices of the faces that change,
/// before and after. settle(n) returns whether it changed the mesh. Trials whose boxes meet that of an earlier one that
/// did are left out, since their tests may no longer hold. The outcome does not depend on the threads.
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

/// The same for the numbers below `size`, in stripes side by side: at the same time are the next numbers of at most
/// kMostStripes stripes, which lie far apart where the numbers follow a curve. What is left out comes once more. Calls
/// test(number, trial) and settle(number, trial); `trial` begins as a copy of `first`.
template <class Trial, class Test, class Settle>
void try_in_stripes(std::uint32_t size, std::uint32_t threads, const Trial& first, Test&& test, Settle&& settle) {
    struct Stripe {
        std::uint32_t at, end;
    };
    const std::uint32_t count = std::clamp(size / kLeastOfStripe, 1u, kMostStripes);
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
