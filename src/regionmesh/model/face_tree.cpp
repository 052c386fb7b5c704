#include "regionmesh/model/face_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "regionmesh/base/radix_sort.h"

namespace regionmesh {
namespace {

/// Spreads the low ten bits, two zeros between each.
std::uint32_t spread(std::uint32_t x) {
    x = (x | x << 16) & 0x030000FFu;
    x = (x | x << 8) & 0x0300F00Fu;
    x = (x | x << 4) & 0x030C30C3u;
    return (x | x << 2) & 0x09249249u;
}

float round_down(double x) {
    const float f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) {
    const float f = static_cast<float>(x);
    return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

FaceTree::FaceTree(const Model& model) {
    sort_faces(model);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Boxes none;
    std::fill(&none.low[0][0], &none.low[0][0] + 24, kInfinity);
    std::fill(&none.high[0][0], &none.high[0][0] + 24, -kInfinity);
    std::size_t groups = (order_.size() + kFan * kFan - 1) / (kFan * kFan);
    for (;;) {
        levels_.emplace_back(std::max<std::size_t>(groups, 1), none);
        if (groups <= 1) break;
        groups = (groups + kFan - 1) / kFan;
    }
    for (std::uint32_t f : order_) {
        Box box;
        for (Vec3 p : model.corners(FaceId{f})) box.add(p);
        grow(FaceId{f}, box);
    }
}

void FaceTree::sort_faces(const Model& model) {
    Box bounds;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v)
        if (model.is_alive(VertexId{v})) bounds.add(model.position(VertexId{v}));
    origin_ = model.vertex_count() ? bounds.low : Vec3{};
    const Vec3 extent = model.vertex_count() ? bounds.high - bounds.low : Vec3{};
    const double largest = std::max({extent.x, extent.y, extent.z, 1e-300});
    std::vector<KeyedIndex> keyed;
    keyed.reserve(model.face_count());
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        const auto [a, b, c] = model.corners(FaceId{f});
        const Vec3 middle = ((a + b + c) / 3.0 - origin_) * (1023.0 / largest);
        const auto cell = [](double x) { return spread(static_cast<std::uint32_t>(std::clamp(x, 0.0, 1023.0))); };
        keyed.push_back({cell(middle.x) | cell(middle.y) << 1 | cell(middle.z) << 2, f});
    }
    radix_sort(keyed);
    order_.reserve(keyed.size());
    place_.resize(model.face_end());
    for (const KeyedIndex& item : keyed) {
        place_[item.index] = static_cast<std::uint32_t>(order_.size());
        order_.push_back(item.index);
    }
}

FaceTree::FloatBox FaceTree::outward(const Box& box) const {
    FloatBox result;
    for (int axis = 0; axis < 3; ++axis) {
        result.low[axis] = round_down(box.low[axis] - origin_[axis]);
        result.high[axis] = round_up(box.high[axis] - origin_[axis]);
    }
    return result;
}

unsigned FaceTree::meeting(const Boxes& boxes, const FloatBox& box) {
#if defined(__SSE__)
    unsigned mask = 0;
    for (std::uint32_t half = 0; half < kFan; half += 4) {
        __m128 in = _mm_cmple_ps(_mm_loadu_ps(boxes.low[0] + half), _mm_set1_ps(box.high[0]));
        in = _mm_and_ps(in, _mm_cmpge_ps(_mm_loadu_ps(boxes.high[0] + half), _mm_set1_ps(box.low[0])));
        for (int axis = 1; axis < 3; ++axis) {
            in = _mm_and_ps(in, _mm_cmple_ps(_mm_loadu_ps(boxes.low[axis] + half), _mm_set1_ps(box.high[axis])));
            in = _mm_and_ps(in, _mm_cmpge_ps(_mm_loadu_ps(boxes.high[axis] + half), _mm_set1_ps(box.low[axis])));
        }
        mask |= static_cast<unsigned>(_mm_movemask_ps(in)) << half;
    }
    return mask;
#else
    unsigned mask = 0;
    for (std::uint32_t lane = 0; lane < kFan; ++lane) {
        bool in = true;
        for (int axis = 0; axis < 3; ++axis) in &= boxes.low[axis][lane] <= box.high[axis] && boxes.high[axis][lane] >= box.low[axis];
        mask |= static_cast<unsigned>(in) << lane;
    }
    return mask;
#endif
}

bool FaceTree::extend(Boxes& boxes, std::uint32_t lane, const FloatBox& box) {
    bool grew = false;
    for (int axis = 0; axis < 3; ++axis) {
        if (box.low[axis] < boxes.low[axis][lane]) {
            boxes.low[axis][lane] = box.low[axis];
            grew = true;
        }
        if (box.high[axis] > boxes.high[axis][lane]) {
            boxes.high[axis][lane] = box.high[axis];
            grew = true;
        }
    }
    return grew;
}

void FaceTree::grow(FaceId f, const Box& box) {
    const FloatBox reach = outward(box);
    std::uint32_t child = place_[index(f)] / kFan;
    for (auto& level : levels_) {
        if (!extend(level[child / kFan], child % kFan, reach)) return;
        child /= kFan;
    }
}

std::size_t FaceTree::bytes() const {
    std::size_t sum = 4 * order_.size() + place_.bytes();
    for (const auto& level : levels_) sum += level.size() * sizeof(Boxes);
    return sum;
}

}  // namespace regionmesh
