#include "smooth/lattice_quadric.h"

#include <cmath>

namespace regionmesh {
namespace {

/// The extent of a simplex depends on the slope of the quadric: fitted again with the slopes found first.
constexpr int kRounds = 2;

/// Added to the diagonal, as a share of the sum of weights, so that few samples give a plane, and one or two a level
/// one.
constexpr double kPlaneRidge = 1e-9, kCurvedRidge = 1e-5;
constexpr double kFewSamples = 2;

using Matrix = std::array<std::array<double, 6>, 6>;

/// Cholesky's method; `a` is symmetric, its lower half is read. False if not positive definite.
bool solve(Matrix& a, std::array<double, 6>& b) {
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) {
            double sum = a[i][j];
            for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
            if (i != j) {
                a[i][j] = sum / a[j][j];
            } else {
                if (!(sum > 0)) return false;
                a[i][i] = std::sqrt(sum);
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (int i = 5; i >= 0; --i) {
        for (int k = i + 1; k < 6; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

}  // namespace

HeightQuadric::HeightQuadric(Vec3 at, Vec3 unit_normal) : centre(at), normal(unit_normal) {
    const Vec3 other = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    u = cross(normal, other);
    u = u / length(u);
    v = cross(normal, u);
}

bool HeightQuadric::fit(std::span<const HeightSample> samples, double reach, double finest_extent) {
    const double few = kFewSamples / static_cast<double>(samples.size());
    const double curved_ridge = kCurvedRidge + few * few * few * few;
    for (int round = 0; round < kRounds; ++round) {
        Matrix a{};
        std::array<double, 6> b{};
        for (const HeightSample& sample : samples) {
            const Vec3 d = sample.position - centre, slope = gradient(sample.position);
            const double s = dot(d, u) / reach, t = dot(d, v) / reach, height = dot(d, normal);
            const ExtentAlong extent = extent_along(sample.edges, slope);
            const double width = (extent.high - extent.low) * (extent.high - extent.low) / length2(slope);
            const double weight = sample.weight / (width + finest_extent * finest_extent);
            const std::array<double, 6> term{1, s, t, s * s, s * t, t * t};
            for (int i = 0; i < 6; ++i) {
                const double weighted = weight * term[i];
                for (int j = 0; j <= i; ++j) a[i][j] += weighted * term[j];
                b[i] += weighted * height;
            }
        }
        const double total = a[0][0];
        for (int i = 0; i < 6; ++i) a[i][i] += total * (i < 3 ? kPlaneRidge : curved_ridge);
        if (!solve(a, b)) return false;
        q = {b[0], b[1] / reach, b[2] / reach, b[3] / (reach * reach), b[4] / (reach * reach), b[5] / (reach * reach)};
    }
    return true;
}

}  // namespace regionmesh
