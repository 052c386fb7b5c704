// The shape of a few faces as one number to lower, and the worst of them.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace regionmesh {

/// Of some faces: the worst quality, to the third power, and the sum of 1 / quality^3.
struct FanShape {
    double worst3 = 1, energy = 0;

    void add(Vec3 a, Vec3 b, Vec3 c) {
        const double own3 = quality_terms(a, b, c).cube();
        worst3 = std::min(worst3, own3);
        energy += own3 > 0 ? 1 / own3 : HUGE_VAL;
    }
    /// Is this better than another for certain, beyond rounding, and worth a change? No worst face may get worse.
    bool is_better_than(const FanShape& other) const {
        return worst3 > 0 && worst3 >= other.worst3 && energy < kWorthChange * other.energy;
    }

private:
    static constexpr double kWorthChange = 1 - 1e-2;
};

}  // namespace regionmesh
