#include "boreholes/kriging.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/parallel_for.h"

namespace regionmesh::formats {
namespace {

constexpr double kNear = 0.01;  // share of the distance to a neighbour
constexpr std::size_t kNeighbour = 3;
constexpr std::size_t kLeastProducts = 1 << 16;  // products of one task
constexpr double kLeastPivot = 1e-13;  // share of the largest diagonal entry; smaller ones are rounding errors

/// -r^1.5: conditionally positive definite, so that weights with the sum 0 make a positive definite matrix.
double covariance(double dx, double dy) {
    const double r = std::sqrt(dx * dx + dy * dy);
    return -r * std::sqrt(r);
}

double covariance(const HeightSample& a, const HeightSample& b) { return covariance(a.x - b.x, a.y - b.y); }

/// A symmetric positive definite matrix, lower rows one after another.
class LowerMatrix {
public:
    explicit LowerMatrix(std::size_t size) : entries_(size * (size + 1) / 2), size_(size) {}

    double* row(std::size_t i) { return entries_.data() + i * (i + 1) / 2; }

    /// Replaces the matrix by its Cholesky factor, column by column.
    void factorise(std::uint32_t threads) {
        double most = 0;
        for (std::size_t i = 0; i < size_; ++i) most = std::max(most, row(i)[i]);
        for (std::size_t j = 0; j < size_; ++j) {
            double* const b = row(j);
            b[j] = std::sqrt(std::max(b[j] - product(b, b, j), kLeastPivot * most));
            const std::size_t chunk = kLeastProducts / (j + 1) + 1, count = (size_ - j - 1 + chunk - 1) / chunk;
            parallel_for(static_cast<std::uint32_t>(count), threads, [&](std::uint32_t n) {
                const std::size_t first = j + 1 + n * chunk, end = std::min(first + chunk, size_);
                for (std::size_t i = first; i < end; ++i) row(i)[j] = (row(i)[j] - product(row(i), b, j)) / b[j];
            });
        }
    }

    /// Solves for the right-hand side in `x`, after factorise().
    void solve(std::vector<double>& x) {
        for (std::size_t i = 0; i < size_; ++i) x[i] = (x[i] - product(row(i), x.data(), i)) / row(i)[i];
        for (std::size_t i = size_; i-- > 0;) {
            x[i] /= row(i)[i];
            for (std::size_t j = 0; j < i; ++j) x[j] -= row(i)[j] * x[i];
        }
    }

private:
    static double product(const double* a, const double* b, std::size_t count) {
        double sum = 0;
        for (std::size_t n = 0; n < count; ++n) sum += a[n] * b[n];
        return sum;
    }

    std::vector<double> entries_;
    std::size_t size_;
};

}  // namespace

double near_distance(const std::vector<HeightSample>& samples) {
    if (samples.size() < 2) return 0;
    const auto neighbour = static_cast<std::ptrdiff_t>(std::min(kNeighbour, samples.size() - 1));
    std::vector<double> of_each, distances(samples.size());
    for (const HeightSample& a : samples) {
        for (std::size_t n = 0; n < samples.size(); ++n)
            distances[n] = std::hypot(samples[n].x - a.x, samples[n].y - a.y);  // 0 to itself
        std::nth_element(distances.begin(), distances.begin() + neighbour, distances.end());
        of_each.push_back(distances[static_cast<std::size_t>(neighbour)]);
    }
    const auto middle = of_each.begin() + static_cast<std::ptrdiff_t>(of_each.size() / 2);
    std::nth_element(of_each.begin(), middle, of_each.end());
    return kNear * *middle;
}

Kriging::Kriging(std::vector<HeightSample> samples, double near, std::uint32_t threads) : samples_(std::move(samples)) {
    assert(!samples_.empty());
    merge_near_samples(near);
    solve(threads);
}

void Kriging::merge_near_samples(double near) {
    const auto position = [](const HeightSample& s) { return std::tuple(s.x, s.y, s.z); };
    std::sort(samples_.begin(), samples_.end(),
              [&](const auto& a, const auto& b) { return position(a) < position(b); });
    std::vector<HeightSample> kept;
    std::vector<double> counts;
    for (const HeightSample& sample : samples_) {
        std::size_t n = kept.size();
        while (n > 0 && sample.x - kept[n - 1].x <= near &&
               std::hypot(sample.x - kept[n - 1].x, sample.y - kept[n - 1].y) > near)
            --n;
        if (n > 0 && sample.x - kept[n - 1].x <= near) {
            kept[n - 1].z += (sample.z - kept[n - 1].z) / ++counts[n - 1];
        } else {
            kept.push_back(sample);
            counts.push_back(1);
        }
    }
    samples_ = std::move(kept);
}

/// Weights with the sum 0 are those of differences to the last sample, which leaves one equation less and no
/// constraint.
void Kriging::solve(std::uint32_t threads) {
    const std::size_t count = samples_.size() - 1;
    const HeightSample& last = samples_.back();
    LowerMatrix matrix(count);
    std::vector<double> differences(count);
    for (std::size_t i = 0; i < count; ++i) {
        differences[i] = samples_[i].z - last.z;
        for (std::size_t j = 0; j <= i; ++j)
            matrix.row(i)[j] =
                covariance(samples_[i], samples_[j]) - covariance(samples_[i], last) - covariance(samples_[j], last);
    }
    matrix.factorise(threads);
    matrix.solve(differences);
    weights_ = std::move(differences);
    double sum = 0;
    for (const double weight : weights_) sum += weight;
    weights_.push_back(-sum);
    constant_ = 0;
    constant_ = last.z - at(last.x, last.y);
}

double Kriging::at(double x, double y) const {
    double height = constant_;
    for (std::size_t n = 0; n < samples_.size(); ++n)
        height += weights_[n] * covariance(x - samples_[n].x, y - samples_[n].y);
    return height;
}

}  // namespace regionmesh::formats
