// Heights between scattered positions: ordinary kriging in the plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace regionmesh::formats {

/// A height at a position.
struct HeightSample {
    double x = 0, y = 0, z = 0;
};

/// Most drill holes of a table. Each gives a surface a sample, or two where one bounds it from above and one from
/// below: the time to solve for the weights grows with the cube of their number.
inline constexpr std::size_t kMostHoles = 3000;

/// Below this distance two positions count as one: a hundredth of the median distance from a position to its third
/// neighbour, which neither pairs nor positions far off decide. The slope between two holes side by side would
/// otherwise tilt the surface far around them.
double near_distance(const std::vector<HeightSample>& samples);

/// The surface through the samples with the least variance of its error, for the power variogram r^1.5. It has no peaks
/// at the samples, as the linear variogram makes them, and tends to the mean far from them.
class Kriging {
public:
    /// Samples no farther from each other than `near` are one sample at their mean height. Requires at least one
    /// sample, and finite coordinates. `threads` as in parallel_for(); the result does not depend on them.
    Kriging(std::vector<HeightSample> samples, double near, std::uint32_t threads = 0);

    double at(double x, double y) const;

private:
    void merge_near_samples(double near);
    void solve(std::uint32_t threads);

    std::vector<HeightSample> samples_;
    std::vector<double> weights_;  // one per item of samples_; their sum is 0
    double constant_ = 0;
};

}  // namespace regionmesh::formats
