#include "smooth/lattice_quadric.h"

#include <algorithm>
#include <bit>
#include <cmath>


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

/// Weights of the samples from the extents of their simplices along the normal of a plane.
class PlaneWeights {
public:
    PlaneWeights(const HeightQuadric& quadric, Float3 spacing) {
        const StepHeights heights = step_heights(quadric.normal, spacing);
        for (int kind = 1; kind < kKindCount; ++kind) {
            const float extent = extent_of(kind, heights);
            shares_[kind] = 1 / (extent * extent + kFinestExtent * kFinestExtent);
        }
    }
    Float4 operator()(const HeightSamples::Four& four) const {
        const auto& kind = four.kind;
        return four.weight * Float4{shares_[kind[0]], shares_[kind[1]], shares_[kind[2]], shares_[kind[3]]};
    }

private:
    std::array<float, kKindCount> shares_{};
};

/// The same along the gradient of a quadric at each sample.
class QuadricWeights {
public:
    QuadricWeights(const HeightQuadric& quadric, Float3 spacing) : q_(quadric.q) {
        for (int step = 1; step < 8; ++step)
            steps_[step] = quadric.along({step & 1 ? spacing.x : 0, step & 2 ? spacing.y : 0, step & 4 ? spacing.z : 0});
    }
    Float4 operator()(const HeightSamples::Four& four) const {
        const Float4 a = q_[1] + 2 * q_[3] * four.u + q_[4] * four.v, b = q_[2] + q_[4] * four.u + 2 * q_[5] * four.v;
        const auto height_of = [&](int s0, int s1, int s2, int s3) {
            const Float3 &e0 = steps_[s0], &e1 = steps_[s1], &e2 = steps_[s2], &e3 = steps_[s3];
            return Float4{e0.z, e1.z, e2.z, e3.z} - a * Float4{e0.x, e1.x, e2.x, e3.x} -
                   b * Float4{e0.y, e1.y, e2.y, e3.y};
        };
        const auto& kind = four.kind;
        Float4 extent;
        if (std::max({kind[0], kind[1], kind[2], kind[3]}) < kFirstTriangle) {  // the kind of an edge is its step
            extent = height_of(kind[0], kind[1], kind[2], kind[3]);
        } else {
            Float4 low{}, high{};
            for (int n = 1; n < 4; ++n) {
                const auto step = [&](int lane) { return kKinds[kind[lane]].steps[n]; };
                const Float4 at = height_of(step(0), step(1), step(2), step(3));
                low = least(low, at);
                high = greatest(high, at);
            }
            extent = high - low;
        }
        const Float4 slope2 = 1 + a * a + b * b;
        return four.weight * slope2 / (extent * extent + kFinestExtent * kFinestExtent * slope2);
    }

private:
    std::array<float, 6> q_;
    std::array<Float3, 8> steps_;  // along u, v and the normal
};

double total(Float4 lanes) { return (double{lanes[0]} + lanes[1]) + (double{lanes[2]} + lanes[3]); }

/// Sums of weight times powers of s and t, and of these times height.
template <class Weights>
void add_up(const HeightSamples& samples, const Weights& weights, float scale, Matrix& a, std::array<double, 6>& b) {
    Float4 m00{}, m10{}, m01{}, m20{}, m11{}, m02{}, m30{}, m21{}, m12{}, m03{}, m40{}, m31{}, m22{}, m13{}, m04{};
    Float4 b0{}, b1{}, b2{}, b3{}, b4{}, b5{};
    for (std::uint32_t n = 0; n < samples.count; ++n) {
        const HeightSamples::Four& four = samples.fours[n];
        const Float4 w = weights(four), s = scale * four.u, t = scale * four.v, h = four.height;
        const Float4 ss = s * s, st = s * t, tt = t * t, ws = w * s, wt = w * t, wss = w * ss, wtt = w * tt, wh = w * h;
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

bool HeightQuadric::fit(const HeightSamples& samples, Float3 spacing, float reach, int rounds) {
    double count = 0;
    for (std::uint32_t n = 0; n < samples.count; ++n) count += std::popcount(bits_of(samples.fours[n].weight > 0));
    const double few = kFewSamples / count;
    const double curved_ridge = kCurvedRidge + few * few * few * few;
    for (int round = 0; round < rounds; ++round) {
        Matrix a{};
        std::array<double, 6> b{};
        if (round == 0)  // still a plane
            add_up(samples, PlaneWeights(*this, spacing), 1 / reach, a, b);
        else
            add_up(samples, QuadricWeights(*this, spacing), 1 / reach, a, b);
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
