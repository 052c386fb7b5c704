#include "mesh/grid_tree.h"

#include <cmath>
#include <cstring>
#include <memory>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace regionmesh {
namespace {

#if defined(__SSE2__)
__m128i eight_of(const std::int16_t* numbers) { return _mm_load_si128(reinterpret_cast<const __m128i*>(numbers)); }
/// Boxes of which some coordinate lies beyond the other's are apart.
unsigned not_apart(__m128i apart) {
    return ~static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(apart, apart))) & 0xFFu;
}
#endif

constexpr std::int16_t kLowest = -32768, kHighest = 32767;
constexpr GridTree::GridBox kNothing{{kHighest, kHighest, kHighest}, {kLowest, kLowest, kLowest}};

}  // namespace

void GridTree::start(std::uint32_t count, const Box& extent) {
    levels_.clear();
    if (!extent.is_empty()) {
        const Vec3 size = extent.high - extent.low;
        origin_ = extent.low;
        cells_per_length_ = 65500 / std::max({size.x, size.y, size.z, 1e-300});
    }
    for (std::uint32_t size = count;;) {
        size = std::max(size / kFan + (size % kFan != 0), 1u);
        levels_.emplace_back().resize_for_overwrite(size);
        if (size == 1) break;
    }
}

void GridTree::build_upper(std::uint32_t threads) {
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        FlatArray<Boxes>&below = levels_[level - 1], &own = levels_[level];
        for_each_index(own.size(), kBuildGroups, threads, [&](std::uint32_t g) {
            Boxes boxes = Boxes::none();
            for (std::uint32_t child = g * kFan; child < std::min(below.size(), (g + 1) * kFan); ++child)
                boxes.put(child % kFan, below[child].hull());
            own[g] = boxes;
        });
    }
}

std::array<GridTree::GridBox, 2> GridTree::outward(const Lanes3<Double2>& low, const Lanes3<Double2>& high) const {
    // Coordinates outside the grid are clamped to its border, on both sides of a comparison; no box reaches as far as
    // the empty one.
    const Double2 scale = both(cells_per_length_), least_cell = both(kLowest + 1.0), most_cell = both(kHighest - 1.0);
    const auto cells_at = [&](Double2 ends, double origin, double rounding) {
        return least(greatest((ends - both(origin)) * scale - both(32760) + both(rounding), least_cell), most_cell);
    };
    const std::array<Double2, 6> cells{cells_at(low.x, origin_.x, -1), cells_at(low.y, origin_.y, -1),
                                       cells_at(low.z, origin_.z, -1), cells_at(high.x, origin_.x, 1),
                                       cells_at(high.y, origin_.y, 1), cells_at(high.z, origin_.z, 1)};
    std::array<GridBox, 2> boxes;
#if defined(__SSE2__)
    const auto two = [&](int n) {
        return _mm_unpacklo_epi32(_mm_cvttpd_epi32(cells[n]), _mm_cvttpd_epi32(cells[n + 1]));
    };
    const __m128i first = two(0), second = two(2), third = two(4);
    const auto store = [](GridBox& box, __m128i four, __m128i last) {
        const __m128i eight = _mm_packs_epi32(four, last);
        std::memcpy(&box, &eight, sizeof(box));
    };
    store(boxes[0], _mm_unpacklo_epi64(first, second), third);
    store(boxes[1], _mm_unpackhi_epi64(first, second), _mm_unpackhi_epi64(third, third));
#else
    for (int lane = 0; lane < 2; ++lane)
        for (int axis = 0; axis < 3; ++axis) {
            boxes[lane].low[axis] = static_cast<std::int16_t>(cells[axis][lane]);
            boxes[lane].high[axis] = static_cast<std::int16_t>(cells[3 + axis][lane]);
        }
#endif
    return boxes;
}

unsigned GridTree::Boxes::meeting(const Boxes& others) const {
#if defined(__SSE2__)
    __m128i out = _mm_setzero_si128();
    for (int axis = 0; axis < 3; ++axis) {
        out = _mm_or_si128(out, _mm_cmpgt_epi16(eight_of(low[axis]), eight_of(others.high[axis])));
        out = _mm_or_si128(out, _mm_cmpgt_epi16(eight_of(others.low[axis]), eight_of(high[axis])));
    }
    return not_apart(out);
#else
    unsigned mask = 0;
    for (std::uint32_t lane = 0; lane < kFan; ++lane) {
        bool in = true;
        for (int axis = 0; axis < 3; ++axis)
            in &= low[axis][lane] <= others.high[axis][lane] && high[axis][lane] >= others.low[axis][lane];
        mask |= static_cast<unsigned>(in) << lane;
    }
    return mask;
#endif
}

unsigned GridTree::Boxes::meeting(const GridBox& box) const {
#if defined(__SSE2__)
    // Each coordinate twice in each of four lanes; then the lane of one coordinate four times.
    const __m128i four = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(box.low));
    const __m128i two = _mm_cvtsi32_si128(load<std::int32_t>(&box.high[1]));
    const __m128i lows_and_high_x = _mm_unpacklo_epi16(four, four), high_y_and_z = _mm_unpacklo_epi16(two, two);
    __m128i out = _mm_cmpgt_epi16(eight_of(low[0]), _mm_shuffle_epi32(lows_and_high_x, 0xFF));
    out = _mm_or_si128(out, _mm_cmpgt_epi16(eight_of(low[1]), _mm_shuffle_epi32(high_y_and_z, 0x00)));
    out = _mm_or_si128(out, _mm_cmpgt_epi16(eight_of(low[2]), _mm_shuffle_epi32(high_y_and_z, 0x55)));
    out = _mm_or_si128(out, _mm_cmpgt_epi16(_mm_shuffle_epi32(lows_and_high_x, 0x00), eight_of(high[0])));
    out = _mm_or_si128(out, _mm_cmpgt_epi16(_mm_shuffle_epi32(lows_and_high_x, 0x55), eight_of(high[1])));
    out = _mm_or_si128(out, _mm_cmpgt_epi16(_mm_shuffle_epi32(lows_and_high_x, 0xAA), eight_of(high[2])));
    return not_apart(out);
#else
    return meeting(all(box));
#endif
}

bool GridTree::extend(Boxes& boxes, std::uint32_t lane, const GridBox& box) {
    bool grew = false;
    for (int axis = 0; axis < 3; ++axis) {
        grew |= box.low[axis] < boxes.low[axis][lane] || box.high[axis] > boxes.high[axis][lane];
        boxes.low[axis][lane] = std::min(boxes.low[axis][lane], box.low[axis]);
        boxes.high[axis][lane] = std::max(boxes.high[axis][lane], box.high[axis]);
    }
    return grew;
}

GridTree::Boxes GridTree::Boxes::none() { return all(kNothing); }

GridTree::Boxes GridTree::Boxes::all(const GridBox& box) {
    Boxes boxes;
    for (int axis = 0; axis < 3; ++axis) {
        std::fill_n(boxes.low[axis], kFan, box.low[axis]);
        std::fill_n(boxes.high[axis], kFan, box.high[axis]);
    }
    return boxes;
}

GridTree::GridBox GridTree::Boxes::operator[](std::uint32_t lane) const {
    return {{low[0][lane], low[1][lane], low[2][lane]}, {high[0][lane], high[1][lane], high[2][lane]}};
}

void GridTree::Boxes::put(std::uint32_t lane, const GridBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
        low[axis][lane] = box.low[axis];
        high[axis][lane] = box.high[axis];
    }
}

GridTree::GridBox GridTree::Boxes::hull() const {
    GridBox result;
    for (int axis = 0; axis < 3; ++axis) {
        result.low[axis] = *std::min_element(low[axis], low[axis] + kFan);
        result.high[axis] = *std::max_element(high[axis], high[axis] + kFan);
    }
    return result;
}

class GridTree::PairList {
public:
    /// Removes all pairs and makes room for the given number, and for those that are written beyond the end.
    Pair* clear(std::size_t room) {
        size_ = 0;
        if (room + kFan > room_) {
            room_ = 2 * (room + kFan);
            pairs_ = std::make_unique_for_overwrite<Pair[]>(room_);
        }
        return pairs_.get();
    }
    /// Writes one pair for each bit of the mask and returns where they end.
    static Pair* write(Pair* to, std::uint32_t m, std::uint32_t first_n, unsigned mask) {
        const std::uint32_t first = Pair(m, first_n).both_;
        for (std::uint32_t k = 0; k < kFan; k += 4) {
            const Unsigned4 four = load<Unsigned4>(&kSetBits.bits[mask][k]) + first;
            std::memcpy(static_cast<void*>(to + k), &four, sizeof(four));
        }
        return to + kSetBits.count[mask];
    }
    /// The pairs end here.
    void end_at(const Pair* end) { size_ = static_cast<std::size_t>(end - pairs_.get()); }

    std::size_t size() const { return size_; }
    const Pair* begin() const { return pairs_.get(); }
    const Pair* end() const { return pairs_.get() + size_; }

private:
    std::unique_ptr<Pair[]> pairs_;
    std::size_t room_ = 0, size_ = 0;
};

/// The part and the other one whose pairs are searched for, and what each level of the search passes to the next.
struct GridTree::PairSearch {
    std::uint32_t part, other;
    std::array<std::vector<GridBox>, 3> boxes;  // boxes of the part, level after level, in order
    PairList groups;                            // pairs of groups a, b
    PairList lanes;                             // group b, and a box of a that meets the bounding box of b
    PairList pairs;                             // a box of a, and a box of b that meets it
};

void GridTree::visit_pairs(std::uint32_t first_part, std::uint32_t end_part,
                           const std::function<void(const PartPairs&)>& visit) const {
    PairSearch search;
    for (std::uint32_t part = first_part; part < end_part; ++part) {
        begin_part(part, search);
        for (std::uint32_t other : parts_near(part)) {
            find_pairs(other, search);
            visit({kFan * first_group(part, 0),
                   kFan * first_group(other, 0),
                   {search.pairs.begin(), search.pairs.end()}});
        }
    }
}

bool GridTree::is_spatial() const {
    constexpr std::uint32_t kParts = 32, kItems = 512, kTests = 24;  // parts sampled, items per part, tests per item
    const std::uint32_t step = std::max(part_count() / kParts, 1u);
    std::uint64_t left = std::uint64_t{kTests} * kItems * std::min(part_count(), kParts);
    PairSearch search;
    for (std::uint32_t part = 0; part < part_count(); part += step) {
        begin_part(part, search);
        for (std::uint32_t other : parts_near(part)) {
            find_pairs(other, search);
            if (search.lanes.size() > left) return false;
            left -= search.lanes.size();
        }
    }
    return true;
}

/// This part and later ones whose bounding boxes meet its own.
std::vector<std::uint32_t> GridTree::parts_near(std::uint32_t part) const {
    const Boxes own = Boxes::all(levels_[part_level()][part].hull());
    std::vector<std::uint32_t> parts;
    std::vector<Entry> stack{root()};
    while (!stack.empty()) {
        const Entry entry = stack.back();
        stack.pop_back();
        if (entry.level == part_level()) {
            parts.push_back(entry.group);
            continue;
        }
        const std::uint32_t below = entry.level - 1;
        for (unsigned mask = levels_[entry.level][entry.group].meeting(own); mask; mask &= mask - 1) {
            const std::uint32_t child = entry.group * kFan + static_cast<std::uint32_t>(__builtin_ctz(mask));
            if (child >= part >> 3 * (below - part_level())) stack.push_back({below, child});
        }
    }
    return parts;
}

/// Lays out the boxes of a part for find_pairs().
void GridTree::begin_part(std::uint32_t part, PairSearch& search) const {
    search.part = part;
    for (std::uint32_t level = 0; level <= part_level(); ++level) {
        search.boxes[level].clear();
        const std::uint32_t end = std::min(first_group(part + 1, level), levels_[level].size());
        for (std::uint32_t g = first_group(part, level); g < end; ++g)
            for (std::uint32_t lane = 0; lane < kFan; ++lane) search.boxes[level].push_back(levels_[level][g][lane]);
    }
}

/// All pairs of an item in the part that was begun and an item in the other.
void GridTree::find_pairs(std::uint32_t other, PairSearch& search) const {
    search.other = other;
    search.pairs.end_at(PairList::write(search.pairs.clear(1), 0, 0, 1));
    for (std::uint32_t level = part_level() + 1; level-- > 0;) {
        std::swap(search.groups, search.pairs);
        pair_lanes(level, search);
    }
}

/// Pairs of groups become pairs of their members. No branches that depend on the data: most would be
/// mispredicted.
void GridTree::pair_lanes(std::uint32_t level, PairSearch& search) const {
    auto& [part, other, boxes, groups, lanes, pairs] = search;
    const std::uint32_t first_a = first_group(part, level), first_b = first_group(other, level);
    const Boxes *const all_a = &levels_[level][first_a], *const all_b = &levels_[level][first_b];
    const Boxes* const hulls = level < root().level ? &levels_[level + 1][0] : nullptr;
    Pair* to = lanes.clear(groups.size() * kFan);
    for (const Pair pair : groups) {
        const std::uint32_t a = pair.m(), b = pair.n(), at = first_b + b;
        const unsigned mask = hulls ? all_a[a].meeting(Boxes::all(hulls[at / kFan][at % kFan])) : 0xFFu;
        to = PairList::write(to, b, a * kFan, mask);
    }
    lanes.end_at(to);
    // Each pair once; an item forms no pair with itself, but a group does.
    const bool is_same_part = part == other;
    const unsigned later = level == 0 ? 0xFEu : 0xFFu;
    to = pairs.clear(lanes.size() * kFan);
    for (const Pair pair : lanes) {
        const std::uint32_t b = pair.m(), m = pair.n(), lane = m % kFan;
        const unsigned wanted = is_same_part & (m / kFan == b) ? later << lane & 0xFFu : 0xFFu;
        to = PairList::write(to, m, b * kFan, all_b[b].meeting(boxes[level][m]) & wanted);
    }
    pairs.end_at(to);
}

void GridTree::set(std::uint32_t item, const GridBox& box) {
    levels_[0][item / kFan].put(item % kFan, box);
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        item /= kFan;
        if (!extend(levels_[level][item / kFan], item % kFan, box)) return;
    }
}

void GridTree::remove(std::uint32_t item) { levels_[0][item / kFan].put(item % kFan, kNothing); }

std::size_t GridTree::bytes() const {
    std::size_t sum = 0;
    for (const FlatArray<Boxes>& level : levels_) sum += level.bytes();
    return sum;
}

}  // namespace regionmesh
