#include "judge/verdict/star_planes.h"

#include <algorithm>

namespace regionmesh {
namespace {

/// The product of a vector of size 1 with another, in floats, is right to less than this share of the other's size; the
/// rounding of the vectors themselves is in it. The absolute part covers numbers too small for floats.
constexpr float kDoubt = 4e-6f;
constexpr float kLeast = 1e-30f;

/// Below this share of the largest that it could have, an area vector computed in doubles is not trusted.
constexpr double kThin = 1e-7;

Float4 size(const Lanes3<Float4>& p) {
    const Float4 zero{};
    return greatest(p.x, zero - p.x) + greatest(p.y, zero - p.y) + greatest(p.z, zero - p.z);
}

void put_pair(Lanes3<Float4>& four, int pair, const Lanes3<Double2>& two) {
    for (int lane = 0; lane < 2; ++lane) {
        four.x[2 * pair + lane] = static_cast<float>(two.x[lane]);
        four.y[2 * pair + lane] = static_cast<float>(two.y[lane]);
        four.z[2 * pair + lane] = static_cast<float>(two.z[lane]);
    }
}

Lanes3<Double2> scaled(const Lanes3<Double2>& p, Double2 factor) { return {p.x * factor, p.y * factor, p.z * factor}; }

}  // namespace

void StarPlanes::prepare(const EdgeStar& star, Vec3 position, int first, int count) {
    position_ = position;
    const Vec3 extent = star.link_box.high - star.link_box.low;
    scale_ = 1 / std::max({extent.x, extent.y, extent.z, 1e-150});
    all_ = count == kMost ? ~0u : (1u << count) - 1;
    planes_.resize(static_cast<std::size_t>(count + 3) / 4);
    const Lanes3<Double2> merged = both(position);
    const Double2 scale = both(scale_), scale2 = both(scale_ * scale_), thin = both(kThin * kThin);
    for (std::size_t g = 0; g < planes_.size(); ++g) {
        Planes& four = planes_[g];
        Lanes3<Float4> at_a{};
        for (int half = 0; half < 2; ++half) {
            const std::size_t n = std::min(first / 2 + 2 * g + half, star.pairs.size() - 1);
            const StarPair& pair = star.pairs[n];
            const Lanes3<Double2> a = scaled(pair.a - merged, scale), b = scaled(pair.b - merged, scale);
            // A face so thin that its normal is not certain reports no plane.
            const Double2 is_sure =
                pair.new_length2 * scale2 * scale2 > thin * dot(a, a) * dot(b, b) ? both(1) : both(0);
            const Lanes3<Double2> normal = scaled(pair.new_normal, scale2 * is_sure);
            put_pair(four.link, half, cross(b - a, normal));
            put_pair(four.a, half, cross(a, normal));
            put_pair(four.b, half, cross(normal, b));
            put_pair(four.own, half, normal);
            put_pair(at_a, half, a);
        }
        for (Lanes3<Float4>* out : {&four.link, &four.a, &four.b, &four.own}) {
            const Float4 inverse = all_four(1) / (size(*out) + all_four(kLeast));
            *out = {out->x * inverse, out->y * inverse, out->z * inverse};
        }
        four.link_offset = dot(four.link, at_a);
        four.link_doubt = all_four(kDoubt) * size(at_a);
    }
}

/// Before a plane is beyond the same plane with all signs turned.
template <bool kIsFar>
Sides StarPlanes::find_sides(Vec3 p) const {
    const Vec3 step = (kIsFar ? -scale_ : scale_) * (p - position_);
    const float x = static_cast<float>(step.x), y = static_cast<float>(step.y), z = static_cast<float>(step.z);
    const Lanes3<Float4> at{all_four(x), all_four(y), all_four(z)};
    const Float4 doubt = all_four(kDoubt * (std::abs(x) + std::abs(y) + std::abs(z)) + kLeast), minus_doubt = -doubt;
    Sides sides;
    int shift = 0;
    for (const Planes& four : planes_) {
        const Float4 own = dot(four.own, at), offset = kIsFar ? -four.link_offset : four.link_offset;
        sides.link |= bits_of(dot(four.link, at) > offset + (four.link_doubt + doubt)) << shift;
        sides.a |= bits_of(dot(four.a, at) > doubt) << shift;
        sides.b |= bits_of(dot(four.b, at) > doubt) << shift;
        sides.above |= bits_of(own > doubt) << shift;
        sides.below |= bits_of(own < minus_doubt) << shift;
        shift += 4;
    }
    return sides;
}

template Sides StarPlanes::find_sides<false>(Vec3 p) const;
template Sides StarPlanes::find_sides<true>(Vec3 p) const;

}  // namespace regionmesh
