#include "mesh/exact_ray.h"

#include "base/exact_predicates.h"
#include "base/hash.h"
#include "mesh/extent.h"

namespace regionmesh {
namespace {

constexpr int kMostLines = 48;
constexpr double kSlope = 0.02;  // keeps the bounding box of a line along an axis thin

enum class Passing { kMisses, kAlongNormal, kAgainstNormal, kDegenerate };

Passing passing(const std::array<Vec3, 3>& p, Vec3 from, Vec3 to) {
    int least = 1, greatest = -1;
    for (int n = 0; n < 3; ++n) {
        const int sign = orientation(from, to, p[n], p[(n + 1) % 3]);
        least = std::min(least, sign);
        greatest = std::max(greatest, sign);
    }
    if (least < 0 && greatest > 0) return Passing::kMisses;
    const int start = orientation(p[0], p[1], p[2], from), end = orientation(p[0], p[1], p[2], to);
    if (start != 0 && start == end) return Passing::kMisses;
    if (least == 0 || greatest == 0 || start == 0 || end == 0) return Passing::kDegenerate;
    return end > 0 ? Passing::kAlongNormal : Passing::kAgainstNormal;
}

/// A point beyond the box, nearly along one of the axes.
Vec3 end_of_line(int number, const Box& box, Vec3 from) {
    const int axis = number / 2 % 3;
    const Vec3 size = box.high - box.low;
    const double reach = size.x + size.y + size.z;
    Vec3 to = from;
    for (int other = 1; other < 3; ++other)
        to[(axis + other) % 3] += reach * kSlope * (2 * hash_unit(number, 100 + other) - 1);
    to[axis] = number % 2 == 0 ? box.high[axis] + 0.01 * reach : box.low[axis] - 0.01 * reach;
    return to;
}

}  // namespace

ExactRay::ExactRay(const Mesh& mesh, const SortedFaceTree& tree)
    : mesh_(mesh), tree_(tree), extent_(extent_of(mesh, 1)) {}

std::optional<std::vector<FacePassed>> ExactRay::faces_passed(Vec3 from,
                                                              const std::function<bool(FaceId)>& is_wanted) const {
    for (int number = 0; number < kMostLines; ++number)
        if (auto faces = faces_between(from, end_of_line(number, extent_, from), is_wanted)) return faces;
    return std::nullopt;
}

std::optional<std::vector<FacePassed>> ExactRay::faces_between(Vec3 from, Vec3 to,
                                                               const std::function<bool(FaceId)>& is_wanted) const {
    Box box;
    box.add(from);
    box.add(to);
    std::vector<FacePassed> passed;
    bool is_degenerate = false;
    tree_.search(box, [&](FaceId f) {
        if (!is_wanted(f)) return true;
        const Passing how = passing(mesh_.corners(f), from, to);
        is_degenerate = how == Passing::kDegenerate;
        if (how != Passing::kMisses) passed.push_back({f, how == Passing::kAlongNormal});
        return !is_degenerate;
    });
    if (is_degenerate) return std::nullopt;
    return passed;
}

}  // namespace regionmesh
