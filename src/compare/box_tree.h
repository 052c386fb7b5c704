// Search for the boxes near a point, eight at a time, nearest first.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace regionmesh {

using FloatPoint = std::array<float, 3>;

/// An axis-aligned box in single precision; callers round it outward.
struct FloatBox {
    FloatPoint low, high;
};

/// Eight boxes side by side; empty slots are infinitely far.
struct alignas(32) EightBoxes {
    static constexpr std::uint32_t kCount = 8;

    std::array<std::array<float, kCount>, 3> low, high;

    EightBoxes();
    void put(std::uint32_t lane, const FloatBox& box);
    /// The bounding box of all boxes put so far.
    FloatBox hull() const;
};

/// Squared distances from p to eight boxes; bit n of the result is set where that to box n is below `limit`.
inline unsigned squared_distances(const EightBoxes& boxes, const FloatPoint& p, float limit,
                                  std::array<float, EightBoxes::kCount>& squared) {
    unsigned below = 0;
#if defined(__SSE2__)
    for (std::uint32_t half = 0; half < EightBoxes::kCount; half += 4) {
        __m128 sum = _mm_setzero_ps();
        for (int axis = 0; axis < 3; ++axis) {
            const __m128 at = _mm_set1_ps(p[axis]);
            const __m128 before = _mm_sub_ps(_mm_load_ps(&boxes.low[axis][half]), at);
            const __m128 behind = _mm_sub_ps(at, _mm_load_ps(&boxes.high[axis][half]));
            const __m128 step = _mm_max_ps(_mm_max_ps(before, behind), _mm_setzero_ps());
            sum = _mm_add_ps(sum, _mm_mul_ps(step, step));
        }
        _mm_storeu_ps(&squared[half], sum);
        below |= static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(sum, _mm_set1_ps(limit)))) << half;
    }
#else
    for (std::uint32_t lane = 0; lane < EightBoxes::kCount; ++lane) {
        float sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float before = boxes.low[axis][lane] - p[axis], behind = p[axis] - boxes.high[axis][lane];
            const float step = std::max(std::max(before, behind), 0.0f);
            sum += step * step;
        }
        squared[lane] = sum;
        below |= static_cast<unsigned>(sum < limit) << lane;
    }
#endif
    return below;
}

/// A box and its squared distance.
struct NearBox {
    float squared;
    std::uint32_t lane;
};

/// The boxes with a squared distance below `limit`, nearest first; returns their number.
inline std::uint32_t near_boxes(const EightBoxes& boxes, const FloatPoint& p, float limit,
                                std::array<NearBox, EightBoxes::kCount>& found) {
    std::array<float, EightBoxes::kCount> squared;
    std::uint32_t count = 0;
    for (unsigned mask = squared_distances(boxes, p, limit, squared); mask; mask &= mask - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(mask));
        std::uint32_t slot = count++;
        for (; slot > 0 && found[slot - 1].squared > squared[lane]; --slot) found[slot] = found[slot - 1];
        found[slot] = {squared[lane], lane};
    }
    return count;
}

/// A tree with eight children a node over named boxes in the given order, which should be spatial.
class BoxTree {
public:
    BoxTree() = default;
    BoxTree(std::span<const FloatBox> boxes, std::vector<std::uint32_t> names);

    bool is_empty() const { return names_.empty(); }

    /// Calls visit(name) for the boxes with a squared distance to p below `limit`, near ones first. A visit may lower
    /// the limit.
    template <class Visit>
    void search(const FloatPoint& p, const float& limit, Visit&& visit) const;

private:
    std::vector<EightBoxes> nodes_;      // level by level, the root last
    std::vector<std::uint32_t> starts_;  // first node of each level
    std::vector<std::uint32_t> names_;
};

template <class Visit>
void BoxTree::search(const FloatPoint& p, const float& limit, Visit&& visit) const {
    if (names_.empty()) return;
    struct Entry {
        float squared;
        std::uint32_t level, node;  // index of the node in its level
    };
    std::array<Entry, 128> stack;  // waiting nodes: at most seven of each of eleven levels
    int top = 0;
    stack[top++] = {0, static_cast<std::uint32_t>(starts_.size()) - 1, 0};
    std::array<NearBox, EightBoxes::kCount> near;
    while (top > 0) {
        const Entry entry = stack[--top];
        if (!(entry.squared < limit)) continue;
        const std::uint32_t count = near_boxes(nodes_[starts_[entry.level] + entry.node], p, limit, near);
        if (entry.level > 0) {
            for (std::uint32_t n = count; n-- > 0;)
                stack[top++] = {near[n].squared, entry.level - 1, entry.node * EightBoxes::kCount + near[n].lane};
            continue;
        }
        for (std::uint32_t n = 0; n < count && near[n].squared < limit; ++n)
            visit(names_[entry.node * EightBoxes::kCount + near[n].lane]);
    }
}

}  // namespace regionmesh
