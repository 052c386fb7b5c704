#include "smooth/shells.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "base/union_find.h"

namespace regionmesh {
namespace {

/// The area vectors of a closed surface sum to zero up to rounding, relative to its area.
constexpr double kClosed = 1e-9;

std::uint64_t key_of(std::uint32_t vertex, Label label) { return std::uint64_t{vertex} << 32 | label; }

}  // namespace

Shells::Shells(const SurfaceWindow& window) {
    join(window);
    note_closed(window);
    before_ = volumes(window, window.origin);
}

/// Joins sides of faces that share a vertex and a label.
void Shells::join(const SurfaceWindow& window) {
    const std::uint32_t faces = window.faces.end();
    std::vector<std::uint64_t> keys;
    keys.reserve(std::size_t{6} * faces);
    for (std::uint32_t f = 0; f < faces; ++f)
        for (std::uint32_t v : window.faces[f].vertices)
            for (Label label : window.faces[f].labels) keys.push_back(key_of(v, label));
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    const auto place = [&](std::uint32_t v, Label label) {
        return static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), key_of(v, label)) - keys.begin());
    };
    UnionFind joined(static_cast<std::uint32_t>(keys.size()));
    shell_.resize(std::size_t{2} * faces);
    for (std::uint32_t f = 0; f < faces; ++f) {
        const auto& v = window.faces[f].vertices;
        for (int side = 0; side < 2; ++side) {
            const Label label = window.faces[f].labels[side];
            shell_[2 * f + side] = place(v[0], label);
            for (int n = 1; n < 3; ++n) joined.join(shell_[2 * f + side], place(v[n], label));
        }
    }
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    std::vector<std::uint32_t> number(keys.size(), kNone);
    for (std::uint32_t& shell : shell_) {
        const std::uint32_t root = joined.find(shell);
        if (number[root] == kNone) {
            number[root] = static_cast<std::uint32_t>(corner_.size());
            corner_.push_back(static_cast<std::uint32_t>(keys[root] >> 32));
        }
        shell = number[root];
    }
}

void Shells::note_closed(const SurfaceWindow& window) {
    std::vector<Vec3> sum(corner_.size());
    std::vector<double> area(corner_.size());
    for (std::uint32_t f = 0; f < window.faces.end(); ++f) {
        const auto& v = window.faces[f].vertices;
        const Vec3 normal = area_vector(window.origin[v[0]], window.origin[v[1]], window.origin[v[2]]);
        for (int side = 0; side < 2; ++side) {
            sum[shell_[2 * f + side]] += (side == 0 ? 1.0 : -1.0) * normal;
            area[shell_[2 * f + side]] += length(normal);
        }
    }
    is_closed_.resize(corner_.size());
    for (std::size_t n = 0; n < corner_.size(); ++n) is_closed_[n] = length(sum[n]) <= kClosed * area[n];
}

std::vector<double> Shells::volumes(const SurfaceWindow& window, const SlidingArray<Vec3>& positions) const {
    std::vector<double> volumes(corner_.size());
    for (std::uint32_t f = 0; f < window.faces.end(); ++f) {
        const auto& v = window.faces[f].vertices;
        for (int side = 0; side < 2; ++side) {
            const std::uint32_t shell = shell_[2 * f + side];
            if (!is_closed_[shell]) continue;
            const Vec3 o = positions[corner_[shell]], a = positions[v[0]] - o;
            const double sixfold = dot(a, cross(positions[v[1]] - o, positions[v[2]] - o));
            volumes[shell] += side == 0 ? sixfold : -sixfold;
        }
    }
    return volumes;
}

std::vector<std::uint32_t> Shells::inverted(const SurfaceWindow& window, const SlidingArray<Vec3>& positions) const {
    std::vector<double> now = volumes(window, positions);
    const auto is_inverted = [&](std::uint32_t shell) {
        return before_[shell] > 0 ? now[shell] <= 0 : before_[shell] < 0 && now[shell] >= 0;
    };
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < window.faces.end(); ++f)
        if (is_inverted(shell_[2 * f]) || is_inverted(shell_[2 * f + 1])) faces.push_back(f);
    return faces;
}

}  // namespace regionmesh
