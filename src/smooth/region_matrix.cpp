#include "smooth/region_matrix.h"

#include <algorithm>
#include <numeric>

namespace regionmesh {

void RegionMatrix::add(std::uint32_t row, std::uint32_t column, double value) {
    if (row == column) {
        diagonal_[row] += value;
        return;
    }
    if (row > column) std::swap(row, column);
    const auto [at, is_new] =
        places_.try_emplace(std::uint64_t{row} << 32 | column, static_cast<std::uint32_t>(entries_.size()));
    if (is_new) entries_.push_back({row, column, 0});
    entries_[at->second].value += value;
}

std::vector<double> RegionMatrix::product(const std::vector<double>& x) const {
    std::vector<double> y(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) y[n] = diagonal_[n] * x[n];
    for (const Entry& entry : entries_) {
        y[entry.row] += entry.value * x[entry.column];
        y[entry.column] += entry.value * x[entry.row];
    }
    return y;
}

std::vector<double> RegionMatrix::solve(const std::vector<double>& b) const {
    constexpr double kTolerance = 1e-10;
    // Below this curvature a direction is in the null space: the rest of b cannot be reached.
    constexpr double kNull = 1e-15;
    const std::size_t size = b.size();
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& c) {
        return std::inner_product(a.begin(), a.end(), c.begin(), 0.0);
    };
    std::vector<double> x(size), r(size), z(size);
    const auto scale = [&] {
        for (std::size_t n = 0; n < size; ++n) z[n] = diagonal_[n] > 0 ? r[n] / diagonal_[n] : 0;
    };
    for (std::size_t n = 0; n < size; ++n) r[n] = diagonal_[n] > 0 ? b[n] : 0;
    scale();
    std::vector<double> p = z;
    double rz = dot(r, z);
    const double enough = kTolerance * kTolerance * rz;
    for (std::size_t step = 0; step < 10 * size + 100 && rz > enough; ++step) {
        const std::vector<double> q = product(p);
        const double curvature = dot(p, q);
        double size_of_p = 0;
        for (std::size_t n = 0; n < size; ++n) size_of_p += diagonal_[n] * p[n] * p[n];
        if (!(curvature > kNull * size_of_p)) break;
        const double length = rz / curvature;
        for (std::size_t n = 0; n < size; ++n) {
            x[n] += length * p[n];
            r[n] -= diagonal_[n] > 0 ? length * q[n] : 0;
        }
        scale();
        const double before = rz;
        rz = dot(r, z);
        for (std::size_t n = 0; n < size; ++n) p[n] = z[n] + rz / before * p[n];
    }
    return x;
}

}  // namespace regionmesh
