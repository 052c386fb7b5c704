#include "judge/verdict/swept_samples.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace regionmesh {
namespace {

/// Share of a length within which a sample counts as reached: far above rounding, and above the distance at which new
/// faces keep from samples (kNear of samples.cpp).
constexpr double kNear = 4e-6;

/// The planes parallel to a face of a tetrahedron, between that face and the opposite corner, a little widened. The
/// tetrahedron lies in its four slabs, even if it is flat.
struct Slab {
    Vec3 from, normal;
    double low, high;  // of normal . (p - from)

    Slab(Vec3 a, Vec3 b, Vec3 c, Vec3 opposite) : from(a), normal(cross(b - a, c - a)) {
        const double height = dot(normal, opposite - a);
        const double margin = kNear * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z) + std::abs(height));
        low = std::min(height, 0.0) - margin;
        high = std::max(height, 0.0) + margin;
    }
    bool holds(Vec3 p) const {
        const double height = dot(normal, p - from);
        return (height >= low) & (height <= high);
    }
    /// Is the point farther than rounding from both ends?
    bool holds_deep(Vec3 p) const {
        const double height = dot(normal, p - from), margin = 2 * std::min(-low, high);
        return height > low + margin && height < high - margin;
    }
};

/// Numbers of samples along an axis.
struct Range {
    std::int64_t first, last;
};

std::int64_t round_up(double x) {
    const auto n = static_cast<std::int64_t>(x);
    return n + (static_cast<double>(n) < x);
}

/// The tetrahedron over a face, in units of the spacing.
class Tetrahedron {
public:
    Tetrahedron(const Lattice& lattice, const std::array<Vec3, 3>& face, Vec3 p) : face_(face), p_(p) {
        const Vec3 low = min(min(face[0], face[1]), min(face[2], p)),
                   high = max(max(face[0], face[1]), max(face[2], p));
        for (int axis = 0; axis < 3; ++axis) {
            const double slack = kNear * (1 + high[axis] - low[axis]), end = lattice.size[axis];
            ranges_[axis] = {round_up(std::clamp(low[axis] - slack, 0.0, end)),
                             -round_up(-std::clamp(high[axis] + slack, -1.0, end - 1))};
        }
    }
    bool has_samples_in_box() const {
        return (ranges_[0].first <= ranges_[0].last) & (ranges_[1].first <= ranges_[1].last) &
               (ranges_[2].first <= ranges_[2].last);
    }

    /// Calls visit(sample) for each sample that is perhaps inside, until it returns false. Looks at lines along the
    /// axis that is steepest on the face: few have a sample in its slab. Returns false, without visits, where the face
    /// is flat.
    template <class Visit>
    bool for_samples(Visit&& visit) const {
        const Slab slab(face_[0], face_[1], face_[2], p_);
        // Axes are as good as random: they index arrays, without branches.
        const std::array normal{slab.normal.x, slab.normal.y, slab.normal.z};
        const std::array from{slab.from.x, slab.from.y, slab.from.z};
        int axis = std::abs(normal[1]) > std::abs(normal[0]);
        axis = std::abs(normal[2]) > std::abs(normal[axis]) ? 2 : axis;
        if (normal[axis] == 0) return false;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double per_step = 1 / normal[axis];
        const double ends[2] = {from[axis] + slab.low * per_step, from[axis] + slab.high * per_step};
        const double low = std::min(ends[0], ends[1]), high = std::max(ends[0], ends[1]);
        const double along_u = normal[u] * per_step, along_v = normal[v] * per_step;
        for (std::int64_t j = ranges_[v].first; j <= ranges_[v].last; ++j)
            for (std::int64_t i = ranges_[u].first; i <= ranges_[u].last; ++i) {
                const double rise =
                    along_u * (static_cast<double>(i) - from[u]) + along_v * (static_cast<double>(j) - from[v]);
                const double end = std::min(high - rise, static_cast<double>(ranges_[axis].last));
                double n =
                    static_cast<double>(round_up(std::max(low - rise, static_cast<double>(ranges_[axis].first))));
                for (; n <= end; ++n) {
                    std::array<double, 3> at;
                    at[axis] = n, at[u] = static_cast<double>(i), at[v] = static_cast<double>(j);
                    const Vec3 sample{at[0], at[1], at[2]};
                    if (is_between_sides(sample) && !visit(sample)) return true;
                }
            }
        return true;
    }

    bool is_deep_inside(Vec3 sample) const {
        if (!Slab(face_[0], face_[1], face_[2], p_).holds_deep(sample)) return false;
        for (int n = 0; n < 3; ++n)
            if (!side(n).holds_deep(sample)) return false;
        return true;
    }
    bool is_outside(Vec3 sample) const {
        return !Slab(face_[0], face_[1], face_[2], p_).holds(sample) || !is_between_sides(sample);
    }

private:
    Slab side(int n) const { return {face_[n], face_[(n + 1) % 3], p_, face_[(n + 2) % 3]}; }
    /// In the slabs of the faces that meet in p.
    bool is_between_sides(Vec3 sample) const {
        for (int n = 0; n < 3; ++n)
            if (!side(n).holds(sample)) return false;
        return true;
    }

    std::array<Vec3, 3> face_;
    Vec3 p_;
    std::array<Range, 3> ranges_;
};

/// A cap that stays in its side of the box sweeps nothing.
bool is_flat_cap(const LabelledTriangle& face, Vec3 p) {
    if (!is_exterior(face.labels[0]) && !is_exterior(face.labels[1])) return false;
    const auto& [a, b, c] = face.at;
    for (int axis = 0; axis < 3; ++axis)
        if (a[axis] == p[axis] && b[axis] == p[axis] && c[axis] == p[axis]) return true;
    return false;
}

}  // namespace

SweptSamples find_swept_samples(const Lattice& lattice, std::span<const LabelledTriangle> before, Vec3 position) {
    const Vec3 per_spacing{1 / lattice.spacing.x, 1 / lattice.spacing.y, 1 / lattice.spacing.z};
    const auto in_spacings = [&](Vec3 p) {
        const Vec3 from_origin = p - lattice.origin;
        return Vec3{from_origin.x * per_spacing.x, from_origin.y * per_spacing.y, from_origin.z * per_spacing.z};
    };
    const Vec3 p = in_spacings(position);
    thread_local std::vector<Tetrahedron> swept;  // those with samples in their boxes
    swept.clear();
    for (const LabelledTriangle& face : before) {
        const auto& [a, b, c] = face.at;
        if (a == position || b == position || c == position || is_flat_cap(face, position)) continue;
        const Tetrahedron own(lattice, {in_spacings(a), in_spacings(b), in_spacings(c)}, p);
        if (own.has_samples_in_box()) swept.push_back(own);
    }
    bool is_clear = true, is_sure = false;
    for (std::size_t n = 0; n < swept.size() && !is_sure; ++n) {
        const bool was_looked_at = swept[n].for_samples([&](Vec3 sample) {
            is_clear = false;
            is_sure = swept[n].is_deep_inside(sample);
            for (std::size_t other = 0; other < swept.size() && is_sure; ++other)
                is_sure = other == n || swept[other].is_outside(sample);
            return !is_sure;
        });
        is_clear = is_clear && was_looked_at;
    }
    return is_sure ? SweptSamples::kSome : is_clear ? SweptSamples::kNone : SweptSamples::kPerhaps;
}

}  // namespace regionmesh
