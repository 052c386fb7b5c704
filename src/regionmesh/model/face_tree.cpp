#include "regionmesh/model/face_tree.h"

#include <algorithm>
#include <cmath>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace regionmesh {
namespace {

constexpr std::int16_t kLowest = -32768, kHighest = 32767;
constexpr FaceTree::GridBox kNothing{{kHighest, kHighest, kHighest}, {kLowest, kLowest, kLowest}};

}  // namespace

FaceTree::FaceTree(std::span<const Box> boxes) {
    Box bounds;
    for (const Box& box : boxes) {
        bounds.add(box.low);
        bounds.add(box.high);
    }
    begin(static_cast<std::uint32_t>(boxes.size()), bounds);
    for (std::uint32_t f = 0; f < boxes.size(); ++f) set(FaceId{f}, boxes[f]);
}

void FaceTree::build(const Model& model) {
    Box bounds;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v)
        if (model.is_alive(VertexId{v})) bounds.add(model.position(VertexId{v}));
    begin(model.face_end(), bounds);
    for (std::uint32_t f = 0; f < model.face_end(); ++f) {
        if (!model.is_alive(FaceId{f})) continue;
        Box box;
        for (Vec3 p : model.corners(FaceId{f})) box.add(p);
        set(FaceId{f}, box);
    }
}

/// Empty boxes for so many faces, in a grid over `bounds`.
void FaceTree::begin(std::uint32_t face_end, const Box& bounds) {
    std::vector<std::vector<Boxes>>().swap(levels_);
    if (bounds.low.x <= bounds.high.x) {
        const Vec3 extent = bounds.high - bounds.low;
        origin_ = bounds.low;
        cells_per_length_ = 65500 / std::max({extent.x, extent.y, extent.z, 1e-300});
    }
    for (std::size_t groups = (face_end + kFan - 1) / kFan;; groups = (groups + kFan - 1) / kFan) {
        levels_.emplace_back(std::max<std::size_t>(groups, 1), Boxes::none());
        if (groups <= 1) break;
    }
}

FaceTree::GridBox FaceTree::outward(const Box& box) const {
    GridBox result;
    for (int axis = 0; axis < 3; ++axis) {
        // Beyond the grid everything counts as being at its rim, on both sides of a comparison; no box reaches as far
        // as the empty one.
        const double low = (box.low[axis] - origin_[axis]) * cells_per_length_ - 32760.0;
        const double high = (box.high[axis] - origin_[axis]) * cells_per_length_ - 32760.0;
        result.low[axis] = static_cast<std::int16_t>(std::clamp(low - 1, kLowest + 1.0, kHighest - 1.0));
        result.high[axis] = static_cast<std::int16_t>(std::clamp(high + 1, kLowest + 1.0, kHighest - 1.0));
    }
    return result;
}

unsigned FaceTree::Boxes::meeting(const GridBox& box) const {
#if defined(__SSE2__)
    __m128i out = _mm_setzero_si128();
    for (int axis = 0; axis < 3; ++axis) {
        const __m128i lowest = _mm_load_si128(reinterpret_cast<const __m128i*>(low[axis]));
        const __m128i highest = _mm_load_si128(reinterpret_cast<const __m128i*>(high[axis]));
        out = _mm_or_si128(out, _mm_cmpgt_epi16(lowest, _mm_set1_epi16(box.high[axis])));
        out = _mm_or_si128(out, _mm_cmplt_epi16(highest, _mm_set1_epi16(box.low[axis])));
    }
    return ~static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(out, out))) & 0xFFu;
#else
    unsigned mask = 0;
    for (std::uint32_t lane = 0; lane < kFan; ++lane) {
        bool in = true;
        for (int axis = 0; axis < 3; ++axis)
            in &= low[axis][lane] <= box.high[axis] && high[axis][lane] >= box.low[axis];
        mask |= static_cast<unsigned>(in) << lane;
    }
    return mask;
#endif
}

bool FaceTree::extend(Boxes& boxes, std::uint32_t lane, const GridBox& box) {
    bool grew = false;
    for (int axis = 0; axis < 3; ++axis) {
        grew |= box.low[axis] < boxes.low[axis][lane] || box.high[axis] > boxes.high[axis][lane];
        boxes.low[axis][lane] = std::min(boxes.low[axis][lane], box.low[axis]);
        boxes.high[axis][lane] = std::max(boxes.high[axis][lane], box.high[axis]);
    }
    return grew;
}

FaceTree::Boxes FaceTree::Boxes::none() {
    Boxes boxes;
    for (std::uint32_t lane = 0; lane < kFan; ++lane) boxes.put(lane, kNothing);
    return boxes;
}

FaceTree::GridBox FaceTree::Boxes::operator[](std::uint32_t lane) const {
    return {{low[0][lane], low[1][lane], low[2][lane]}, {high[0][lane], high[1][lane], high[2][lane]}};
}

void FaceTree::Boxes::put(std::uint32_t lane, const GridBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
        low[axis][lane] = box.low[axis];
        high[axis][lane] = box.high[axis];
    }
}

void FaceTree::set(FaceId f, const Box& box) {
    const GridBox grid = outward(box);
    std::uint32_t child = index(f);
    levels_[0][child / kFan].put(child % kFan, grid);
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        child /= kFan;
        if (!extend(levels_[level][child / kFan], child % kFan, grid)) return;
    }
}

void FaceTree::remove(FaceId f) { levels_[0][index(f) / kFan].put(index(f) % kFan, kNothing); }

std::size_t FaceTree::bytes() const {
    std::size_t sum = 0;
    for (const auto& level : levels_) sum += level.size() * sizeof(Boxes);
    return sum;
}

}  // namespace regionmesh
