#include "volume/exact_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace regionmesh {
namespace {

constexpr double kSteps = 12;                                     // least common multiple of two, three and four
constexpr int kDigits = std::numeric_limits<double>::digits - 2;  // sums of three differences need two more

}  // namespace

void move_to_exact_grid(std::vector<Vec3>& points) {
    for (int axis = 0; axis < 3; ++axis) {
        double most = 0;
        for (const Vec3& p : points) most = std::max(most, std::abs(p[axis]));
        if (most < std::numeric_limits<double>::min() * 0x1p60) continue;  // zeros, or close to the smallest numbers
        int exponent = 0;
        std::frexp(most, &exponent);  // most < 2^exponent
        const double unit = std::ldexp(1.0, exponent - kDigits);
        const auto on_grid = [&](double x) {
            const double moved = std::nearbyint(x / unit / kSteps) * kSteps * unit;
            return std::isfinite(moved) ? moved : x;
        };
        for (Vec3& p : points) p[axis] = on_grid(p[axis]);
    }
}

double nearest_power_of_two(double factor) { return std::exp2(std::round(std::log2(factor))); }

}  // namespace regionmesh
