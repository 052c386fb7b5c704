#include "smooth/lattice/lattice_quadric.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace regionmesh {
namespace {

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

/// Weights of the samples from the extents of their simplices along the normal of a plane. `steps` are along u, v and
/// the normal.
class PlaneWeights {
public:
    PlaneWeights(const StepVectors& steps, float least_extent) {
        for (int kind = 1; kind < kKindCount; ++kind) {
            float low = 0, high = 0;
            for (int n = 1; n < kKinds[kind].node_count; ++n) {
                const float at = steps[kKinds[kind].steps[n]].z;
                low = std::min(low, at);
                high = std::max(high, at);
            }
            shares_[kind] = 1 / ((high - low) * (high - low) + least_extent * least_extent);
        }
    }
    Float4 operator()(const HeightSamples::Four& four) const {
        const Kinds4& kind = four.kind;
        return four.weight * Float4{shares_[kind[0]], shares_[kind[1]], shares_[kind[2]], shares_[kind[3]]};
    }

private:
    std::array<float, kKindCount> shares_{};
};

/// The same along the gradient of a quadric at each sample.
class QuadricWeights {
public:
    QuadricWeights(const StepVectors& steps, const std::array<double, 6>& q, float least_extent)
        : steps_(steps), least_extent2_(least_extent * least_extent) {
        for (int n = 0; n < 6; ++n) q_[n] = static_cast<float>(q[n]);
    }
    Float4 operator()(const HeightSamples::Four& four) const {
        const Float4 a = q_[1] + 2 * q_[3] * four.u + q_[4] * four.v, b = q_[2] + q_[4] * four.u + 2 * q_[5] * four.v;
        const Extent4 extent = extent_of(four.kind, [&](int n) {
            const Lanes3<Float4> step = steps_.to_node(four.kind, n);
            return step.z - a * step.x - b * step.y;
        });
        const Float4 size = extent.high - extent.low, slope2 = 1 + a * a + b * b;
        return four.weight * slope2 / (size * size + least_extent2_ * slope2);
    }

private:
    const StepVectors& steps_;
    float least_extent2_;
    std::array<float, 6> q_;
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

StepVectors::StepVectors(Float3 spacing) {
    for (Step step = 0; step < 8; ++step)
        steps_[step] = {step & 1 ? spacing.x : 0, step & 2 ? spacing.y : 0, step & 4 ? spacing.z : 0};
    for (int kind = 1; kind < kFirstTriangle; ++kind) edge_[kind] = steps_[kKinds[kind].steps[1]];
}

TangentFrame::TangentFrame(Float3 unit_normal) : normal(unit_normal) {
    const Float3 other = std::abs(normal.x) < 0.6f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    u = cross(normal, other);
    u = (1 / length(u)) * u;
    v = cross(normal, u);
}

bool HeightQuadric::fit(const HeightSamples& samples, const TangentFrame& frame, Float3 spacing, float reach,
                        int rounds, float least_extent) {
    double count = 0;
    for (std::uint32_t n = 0; n < samples.count; ++n) count += std::popcount(bits_of(samples.fours[n].weight > 0));
    const double few = kFewSamples / count;
    const double curved_ridge = kCurvedRidge + few * few * few * few;
    StepVectors steps(spacing);
    for (Step step = 0; step < 8; ++step) steps[step] = frame.along(steps[step]);
    std::array<double, 6> q;
    for (int round = 0; round < rounds; ++round) {
        Matrix a{};
        std::array<double, 6> b{};
        if (round == 0)  // still a plane
            add_up(samples, PlaneWeights(steps, least_extent), 1 / reach, a, b);
        else
            add_up(samples, QuadricWeights(steps, q, least_extent), 1 / reach, a, b);
        const double all = a[0][0];
        for (int i = 0; i < 6; ++i) a[i][i] += all * (i < 3 ? kPlaneRidge : curved_ridge);
        if (!solve(a, b)) return false;
        const double r = reach;
        q = {b[0], b[1] / r, b[2] / r, b[3] / (r * r), b[4] / (r * r), b[5] / (r * r)};
    }
    set_heights(q, frame);
    return true;
}

/// From heights over the plane to heights over the surface.
void HeightQuadric::set_heights(const std::array<double, 6>& q, const TangentFrame& frame) {
    std::array<float, 6> f;
    for (int n = 0; n < 6; ++n) f[n] = static_cast<float>(q[n]);
    constant = -f[0];
    gradient = frame.normal - f[1] * frame.u - f[2] * frame.v;
    const float u[3] = {frame.u.x, frame.u.y, frame.u.z}, v[3] = {frame.v.x, frame.v.y, frame.v.z};
    const auto second = [&](int i, int j) {
        return -(2 * f[3] * u[i] * u[j] + f[4] * (u[i] * v[j] + v[i] * u[j]) + 2 * f[5] * v[i] * v[j]);
    };
    curvature = {second(0, 0), second(1, 1), second(2, 2), second(0, 1), second(0, 2), second(1, 2)};
}

}  // namespace regionmesh
