#include "smooth/lattice_quadric.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace regionmesh {
namespace {

/// Least extent of a simplex in weights, in finest spacings.
constexpr float kFinestExtent = 0.1f;

/// Added to the diagonal, as a share of the sum of weights, so that few samples give a plane, and one or two a level
/// one. Above the rounding of sums in single precision.
constexpr double kPlaneRidge = 1e-6, kCurvedRidge = 1e-5;
constexpr double kFewSamples = 2;

using Matrix = std::array<std::array<double, 6>, 6>;

/// Cholesky's method; `a` is symmetric, its lower half is read. False if not positive definite.
bool solve(Matrix& a, std::array<double, 6>& b) {
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) {
            double sum = a[i][j];
            for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
            if (i != j) {
                a[i][j] = sum * a[j][j];  // the diagonal holds inverses
            } else {
                if (!(sum > 0)) return false;
                a[i][i] = 1 / std::sqrt(sum);
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] *= a[i][i];
    }
    for (int i = 5; i >= 0; --i) {
        for (int k = i + 1; k < 6; ++k) b[i] -= a[k][i] * b[k];
        b[i] *= a[i][i];
    }
    return true;
}

/// slope . step for the eight steps in a cell.
using StepHeights = std::array<float, 8>;
StepHeights step_heights(Float3 slope, Float3 spacing) {
    const float x = slope.x * spacing.x, y = slope.y * spacing.y, z = slope.z * spacing.z;
    return {0, x, y, x + y, z, x + z, y + z, x + y + z};
}

float extent_of(int kind, const StepHeights& heights) {
    const SimplexKind& simplex = kKinds[kind];
    if (simplex.node_count == 2) return std::abs(heights[simplex.steps[1]]);
    float low = 0, high = 0;
    for (int n = 1; n < simplex.node_count; ++n) {
        low = std::min(low, heights[simplex.steps[n]]);
        high = std::max(high, heights[simplex.steps[n]]);
    }
    return high - low;
}

/// Weights of the samples from the extents of their simplices.
void weigh(const HeightQuadric& quadric, HeightSamples& samples, Float3 spacing, bool is_first) {
    std::vector<float>& weights = samples.scaled_weight;
    const auto weight = [](float given, float extent, float slope2) {
        return given / (extent * extent / slope2 + kFinestExtent * kFinestExtent);
    };
    if (is_first) {  // still a plane
        const StepHeights heights = step_heights(quadric.normal, spacing);
        std::array<float, kKindCount> extents{};
        for (int kind = 1; kind < kKindCount; ++kind) extents[kind] = extent_of(kind, heights);
        for (std::uint32_t n = 0; n < samples.count; ++n)
            weights[n] = weight(samples.weight[n], extents[samples.kind[n]], 1);
        return;
    }
    for (std::uint32_t n = 0; n < samples.count; ++n) {
        const Float3 slope = quadric.gradient({samples.u[n], samples.v[n], 0});
        weights[n] =
            weight(samples.weight[n], extent_of(samples.kind[n], step_heights(slope, spacing)), dot(slope, slope));
    }
}

constexpr std::uint32_t kLanes = 4;
typedef float Lanes __attribute__((vector_size(4 * kLanes)));

Lanes load(const float* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}
double total(Lanes lanes) { return (double{lanes[0]} + lanes[1]) + (double{lanes[2]} + lanes[3]); }

/// Sums of weight times powers of s and t, and of these times height.
void add_up(const HeightSamples& samples, float scale, Matrix& a, std::array<double, 6>& b) {
    Lanes m00{}, m10{}, m01{}, m20{}, m11{}, m02{}, m30{}, m21{}, m12{}, m03{}, m40{}, m31{}, m22{}, m13{}, m04{};
    Lanes b0{}, b1{}, b2{}, b3{}, b4{}, b5{};
    for (std::uint32_t n = 0; n < samples.count; n += kLanes) {
        const Lanes w = load(&samples.scaled_weight[n]), s = scale * load(&samples.u[n]),
                    t = scale * load(&samples.v[n]);
        const Lanes h = load(&samples.height[n]);
        const Lanes ss = s * s, st = s * t, tt = t * t, ws = w * s, wt = w * t, wss = w * ss, wtt = w * tt, wh = w * h;
        m00 += w, m10 += ws, m01 += wt, m20 += wss, m11 += w * st, m02 += wtt;
        m30 += wss * s, m21 += wss * t, m12 += wtt * s, m03 += wtt * t;
        m40 += wss * ss, m31 += wss * st, m22 += wss * tt, m13 += wtt * st, m04 += wtt * tt;
        b0 += wh, b1 += wh * s, b2 += wh * t, b3 += wh * ss, b4 += wh * st, b5 += wh * tt;
    }
    const double c20 = total(m20), c11 = total(m11), c02 = total(m02), c30 = total(m30), c21 = total(m21);
    const double c12 = total(m12), c03 = total(m03), c22 = total(m22), c31 = total(m31), c13 = total(m13);
    a[0] = {total(m00)};
    a[1] = {total(m10), c20};
    a[2] = {total(m01), c11, c02};
    a[3] = {c20, c30, c21, total(m40)};
    a[4] = {c11, c21, c12, c31, c22};
    a[5] = {c02, c12, c03, c22, c13, total(m04)};
    b = {total(b0), total(b1), total(b2), total(b3), total(b4), total(b5)};
}

}  // namespace

/// With room for lanes behind the last sample.
void HeightSamples::make_room(std::uint32_t size) {
    size += kLanes;
    if (kind.size() >= size) return;
    for (auto* values : {&u, &v, &height, &weight, &scaled_weight}) values->resize(size + size / 2);
    kind.resize(size + size / 2);
}

ExtentAlong extent_along(int kind, Float3 slope, Float3 spacing) {
    const StepHeights heights = step_heights(slope, spacing);
    const SimplexKind& simplex = kKinds[kind];
    float low = 0, high = 0, sum = 0;
    for (int n = 1; n < simplex.node_count; ++n) {
        const float at = heights[simplex.steps[n]];
        low = std::min(low, at);
        high = std::max(high, at);
        sum += at;
    }
    const float middle = sum / static_cast<float>(simplex.node_count);
    return {low - middle, high - middle};
}

HeightQuadric::HeightQuadric(LatticePoint at, Float3 unit_normal) : centre(at), normal(unit_normal) {
    const Float3 other = std::abs(normal.x) < 0.6f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    u = cross(normal, other);
    u = (1 / length(u)) * u;
    v = cross(normal, u);
}

bool HeightQuadric::fit(HeightSamples& samples, Float3 spacing, float reach, int rounds) {
    const double few = kFewSamples / static_cast<double>(samples.count);
    const double curved_ridge = kCurvedRidge + few * few * few * few;
    for (std::uint32_t n = samples.count; n % kLanes != 0; ++n) {
        samples.set(n, {}, 0, 1);
        samples.scaled_weight[n] = 0;
    }
    for (int round = 0; round < rounds; ++round) {
        weigh(*this, samples, spacing, round == 0);
        Matrix a{};
        std::array<double, 6> b{};
        add_up(samples, 1 / reach, a, b);
        const double all = a[0][0];
        for (int i = 0; i < 6; ++i) a[i][i] += all * (i < 3 ? kPlaneRidge : curved_ridge);
        if (!solve(a, b)) return false;
        const double r = reach;
        const double found[6] = {b[0], b[1] / r, b[2] / r, b[3] / (r * r), b[4] / (r * r), b[5] / (r * r)};
        for (int i = 0; i < 6; ++i) q[i] = static_cast<float>(found[i]);
    }
    return true;
}

}  // namespace regionmesh
