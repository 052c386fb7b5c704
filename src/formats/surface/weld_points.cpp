#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>
#include <utility>

#include "base/hash.h"
#include "formats/surface/file_surface.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Smallest width of a cell, relative to the largest coordinate: near the precision of the coordinates.
constexpr double kFinest = 0x1p-45;

/// The kept points, in cells as wide as the distance.
class PointCells {
public:
    PointCells(const std::vector<Vec3>& points, double distance)
        : points_(points), distance2_(distance * distance), next_(points.size(), kNone) {
        double most = 0;
        for (Vec3 p : points) most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (distance > 0) width_ = std::max(distance, most * kFinest);
    }

    /// The nearest kept point within the distance, the first of several; otherwise keeps point n and returns it.
    std::uint32_t find_or_add(std::uint32_t n) {
        const Vec3 p = points_[n], cell = cell_of(p);
        std::uint32_t nearest = kNone;
        double least = HUGE_VAL;
        const int reach = width_ > 0 ? 1 : 0;
        for (int x = -reach; x <= reach; ++x)
            for (int y = -reach; y <= reach; ++y)
                for (int z = -reach; z <= reach; ++z) {
                    const auto at = first_.find(hash_of(cell + Vec3{1.0 * x, 1.0 * y, 1.0 * z}));
                    if (at == first_.end()) continue;
                    for (std::uint32_t m = at->second; m != kNone; m = next_[m]) {
                        const double away = points_[m] == p ? 0 : length2(points_[m] - p);
                        if (away > distance2_ || (away == 0 && points_[m] != p && distance2_ == 0)) continue;
                        if (away < least || (away == least && m < nearest)) least = away, nearest = m;
                    }
                }
        if (nearest != kNone) return nearest;
        const auto [at, is_new] = first_.try_emplace(hash_of(cell), n);
        if (!is_new) next_[n] = std::exchange(at->second, n);
        return n;
    }

private:
    /// With distance 0 each place is its own cell.
    Vec3 cell_of(Vec3 p) const {
        if (!(width_ > 0)) return p;
        return {std::floor(p.x / width_), std::floor(p.y / width_), std::floor(p.z / width_)};
    }
    static std::uint64_t hash_of(Vec3 cell) {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            std::uint64_t bits;
            const double value = cell[axis] + 0.0;  // -0 and 0 are the same place
            std::memcpy(&bits, &value, sizeof bits);
            hash = mix64(hash ^ bits);
        }
        return hash;
    }

    const std::vector<Vec3>& points_;
    double distance2_, width_ = 0;
    std::unordered_map<std::uint64_t, std::uint32_t> first_;  // by hash of the cell: a point of its list
    std::vector<std::uint32_t> next_;                         // in the list of a cell
};

/// Renumbers the points that faces use, in order, and removes the others.
void drop_unused(FileSurface& surface) {
    std::vector<std::uint32_t> number(surface.points.size(), kNone);
    for (const auto& face : surface.faces)
        for (std::uint32_t v : face) number[v] = 0;
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == kNone) continue;
        surface.points[count] = surface.points[v];
        number[v] = count++;
    }
    surface.points.resize(count);
    for (auto& face : surface.faces)
        for (std::uint32_t& v : face) v = number[v];
}

}  // namespace

void weld_points(FileSurface& surface, double distance) {
    std::vector<std::uint32_t> joined(surface.points.size());
    {
        PointCells cells(surface.points, distance);
        for (std::uint32_t v = 0; v < joined.size(); ++v) joined[v] = cells.find_or_add(v);
    }
    std::size_t kept = 0;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        auto face = surface.faces[f];
        for (std::uint32_t& v : face) v = joined[v];
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        surface.faces[kept] = face;
        surface.labels[kept++] = surface.labels[f];
    }
    surface.faces.resize(kept);
    surface.labels.resize(kept);
    drop_unused(surface);
    surface.has_shared_points = true;
}

void join_back_to_back(FileSurface& surface) {
    struct Key {
        std::array<std::uint32_t, 3> corners;  // sorted
        std::uint32_t face;
        bool is_odd;  // the face has them in odd permutation
    };
    const InputLabel exterior = surface.exterior_label;
    std::vector<Key> keys;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        Key key{surface.faces[f], f, false};
        for (const int n : {0, 1, 0}) {
            if (key.corners[n] <= key.corners[n + 1]) continue;
            std::swap(key.corners[n], key.corners[n + 1]);
            key.is_odd = !key.is_odd;
        }
        keys.push_back(key);
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.face < b.face;
    });
    std::vector<bool> is_gone(surface.faces.size());
    for (std::size_t first = 0, end = 1; first < keys.size(); first = end++) {
        while (end < keys.size() && keys[end].corners == keys[first].corners) ++end;
        if (end - first != 2) continue;
        const Key &one = keys[first], &other = keys[first + 1];
        auto &labels = surface.labels[one.face], &behind = surface.labels[other.face];
        if (one.is_odd == other.is_odd || labels[1] != exterior || behind[1] != exterior || labels[0] == behind[0])
            continue;
        labels[1] = behind[0];
        is_gone[other.face] = true;
    }
    std::size_t kept = 0;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        if (is_gone[f]) continue;
        surface.faces[kept] = surface.faces[f];
        surface.labels[kept++] = surface.labels[f];
    }
    surface.faces.resize(kept);
    surface.labels.resize(kept);
}

}  // namespace regionmesh
