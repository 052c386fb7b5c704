// Begins again where smoothing needs to hold more than it did.
#pragma once

#include <optional>
#include <utility>

#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"
#include "smooth/settle.h"

namespace regionmesh {

/// Where the guard finds that it let go of strips too early, which takes labels that no instrument gives, all begins
/// again and holds more; in the end all is in core, where the guard cannot fail. `once(options)` runs, `begin_again()`
/// is false where that cannot be.
template <class Once, class BeginAgain>
Reconstruction run_until_held(ReconstructOptions options, Once&& once, BeginAgain&& begin_again) {
    constexpr std::uint32_t kMoreHold = 8;  // strips beyond the usual
    double total = 0;
    std::optional<Reconstruction> result;
    while (!result) {
        const Timer timer(total);
        try {
            result = once(options);
        } catch (const HeldTooFew&) {
            if (!begin_again()) throw;
            options.smooth.more_hold = 2 * options.smooth.more_hold + kMoreHold;
        }
    }
    result->report.seconds["total"] = total;
    return std::move(*result);
}

}  // namespace regionmesh
