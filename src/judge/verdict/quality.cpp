#include "judge/verdict/quality.h"

#include <algorithm>

#include "base/triangle.h"
#include "judge/tuning.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

double cube_of_bound(const ShapeBounds& bounds) {
    // A little more than asked, so that rounding does not take a face below when it is measured from another corner.
    return bounds.min_quality * bounds.min_quality * bounds.min_quality * (1 + 1e-12);
}

/// Third power of the quality of each of two faces from a vertex to the link, given twice the areas squared
/// (QualityTerms::cube, side by side).
Double2 quality3(const StarPair& pair, const Lanes3<Double2>& to_a, const Lanes3<Double2>& to_b, Double2 length2) {
    const Double2 area = both(0.5) * square_root(length2);
    const Double2 product = quality_product(area, dot(to_a, to_a), dot(to_b, to_b), pair.link_length2);
    return area * area * area / (product * product);
}

/// The least quality of the faces of a star, to the third power, and how many are below the bound.
struct LowQuality {
    double worst3;
    int below;
};

/// The faces of `goes` come first in a star.
int faces_of_goes(const EdgeStar& star) {
    int count = 0;
    while (count < star.face_count() && star.faces[count].apex == star.goes) ++count;
    return count;
}

/// May a collapse leave such faces? Where some came in below the bound: no more than there were, those that vanish
/// counted, and none worse than the worst; or fewer, and a little worse than the worst (kLeastOfWorst, kLeastOfBound).
/// Without the latter, three needles round a tiny face stay for ever: when one goes with an edge of that face, the
/// others get a little longer. Looks at the first `count` faces that survive.
bool may_leave(const Mesh& mesh, const EdgeStar& star, int count, const LowQuality& after, double bound3) {
    LowQuality before{1, 0};
    const auto add = [&](double face3) {
        before.worst3 = std::min(before.worst3, face3);
        before.below += face3 < bound3;
    };
    for (int first = 0; first < count; first += 2) {
        const StarPair& pair = star.pairs[first / 2];
        const int second = std::min(first + 1, count - 1);
        const Lanes3<Double2> apex = side_by_side(star.at_apex(first), star.at_apex(second));
        const Double2 own3 = quality3(pair, pair.a - apex, pair.b - apex, pair.old_length2);
        for (int lane = 0; lane < 2 && first + lane < count; ++lane)
            add(std::max<double>(0, own3[lane]));  // 0 where corners coincide
    }
    for (const FaceId f : star.dead) {
        const auto corners = mesh.corners(f);
        add(quality_terms(corners[0], corners[1], corners[2]).cube());
    }
    if (after.below >= before.below) return after.below == before.below && after.worst3 >= before.worst3;
    constexpr double kOfWorst3 = kLeastOfWorst * kLeastOfWorst * kLeastOfWorst,
                     kOfBound3 = kLeastOfBound * kLeastOfBound * kLeastOfBound;
    return after.worst3 >= std::min(before.worst3, std::max(kOfWorst3 * before.worst3, kOfBound3 * bound3));
}

}  // namespace

Verdict test_quality(const Judge& judge, Change& change) {
    const EdgeStar& star = change.star;
    const double bound3 = cube_of_bound(judge.bounds());
    const Lanes3<Double2> merged = both(change.position);
    double worst3 = 1;
    int below = 0;
    for (std::size_t n = 0; n < star.pairs.size(); ++n) {
        const StarPair& pair = star.pairs[n];
        const Double2 own3 = quality3(pair, pair.a - merged, pair.b - merged, pair.new_length2);
        for (int lane = 0; lane < 2; ++lane) {
            if (own3[lane] < worst3) worst3 = own3[lane];
            below += (own3[lane] < bound3) & (2 * static_cast<int>(n) + lane < star.face_count());
        }
    }
    change.worst_quality3 = worst3;
    return below > 0 && !may_leave(judge.mesh(), star, star.face_count(), {worst3, below}, bound3) ? Verdict::kQuality
                                                                                                   : Verdict::kAccepted;
}

double fan_quality3(const Mesh& mesh, const EdgeStar& around, VertexId target, Vec3 at_target,
                    const ShapeBounds& bounds) {
    const Lanes3<Double2> merged = both(at_target);
    const double bound3 = cube_of_bound(bounds);
    const int count = faces_of_goes(around);
    LowQuality after{1, 0};
    for (int first = 0; first < count; first += 2) {
        const StarPair& pair = around.pairs[first / 2];
        const Lanes3<Double2> to_a = pair.a - merged, to_b = pair.b - merged, normal = cross(to_a, to_b);
        const Double2 normal2 = dot(normal, normal);
        const Double2 own3 = quality3(pair, to_a, to_b, normal2);
        const unsigned kept =
            bits_of(keep_direction(pair.old_normal, pair.old_length2, normal, normal2, bounds.min_turn_cosine));
        for (int lane = 0; lane < 2 && first + lane < count; ++lane) {
            const StarFace& face = around.faces[first + lane];
            const bool stays = (face.a != target) & (face.b != target);  // the others vanish
            if (stays & ((kept >> lane & 1) == 0)) return 0;
            after.worst3 = std::min<double>(after.worst3, stays ? own3[lane] : 1);
            after.below += stays & (own3[lane] < bound3);
        }
    }
    return after.below > 0 && !may_leave(mesh, around, count, after, bound3) ? 0 : after.worst3;
}

}  // namespace regionmesh
