// A bounding volume hierarchy with 16-bit coordinates that compares eight boxes at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/lanes.h"
#include "base/parallel_for.h"
#include "regionmesh/flat_array.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The bits of each number below 256, and how many are set.
struct SetBits {
    alignas(16) std::uint32_t bits[256][8];
    std::uint8_t count[256];
};
constexpr SetBits make_set_bits() {
    SetBits table{};
    for (unsigned mask = 0; mask < 256; ++mask)
        for (std::uint32_t bit = 0; bit < 8; ++bit)
            if (mask >> bit & 1) table.bits[mask][table.count[mask]++] = bit;
    return table;
}
inline constexpr SetBits kSetBits = make_set_bits();

/// A tree of degree 8 over the items 0 .. count - 1 of a list of boxes; fast if their order is spatial. Boxes are
/// rounded outward to 1/65500 of the whole extent, 2 bytes per coordinate: 14 bytes per item in total.
class GridTree {
public:
    static constexpr std::uint32_t kFan = 8;

    /// A box in grid cells.
    struct GridBox {
        std::int16_t low[3];
        std::int16_t high[3];

        void join(const GridBox& other) {
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], other.low[axis]);
                high[axis] = std::max(high[axis], other.high[axis]);
            }
        }
    };
    /// Eight boxes, one per lane.
    struct alignas(16) Boxes {
        std::int16_t low[3][kFan];
        std::int16_t high[3][kFan];

        /// Eight empty boxes, which meet nothing.
        static Boxes none();
        /// The same box eight times.
        static Boxes all(const GridBox& box);
        GridBox operator[](std::uint32_t lane) const;
        void put(std::uint32_t lane, const GridBox& box);
        /// The bounding box of all eight.
        GridBox hull() const;
        /// Bit n is set if box n meets box n of the others.
        unsigned meeting(const Boxes& others) const;
        /// The same for one box. Slow if single coordinates of it were written just now: four are loaded at once.
        unsigned meeting(const GridBox& box) const;
    };

    /// Rebuilds the tree; releases the old boxes first. box_of(n) returns the box at item n, or an empty box; it is
    /// called on several threads. `extent` is the bounding box of all.
    template <class BoxOf>
    void build(std::uint32_t count, const Box& extent, std::uint32_t threads, BoxOf&& box_of);

    /// Boxes of the grid that contain two boxes side by side.
    std::array<GridBox, 2> outward(const Lanes3<Double2>& low, const Lanes3<Double2>& high) const;
    GridBox outward(const Box& box) const { return outward(both(box.low), both(box.high))[0]; }

    /// Changes the box at an item. The boxes above it grow and never shrink.
    void set(std::uint32_t item, const GridBox& box);
    /// Empties the item.
    void remove(std::uint32_t item);

    /// Calls visit(span of items) until all items whose rounded box meets `box` have been visited, in order, with
    /// at most kMostAtOnce at once. A visit that returns false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        const std::uint32_t first = 0;
        search_below(root().level, {&first, 1}, Boxes::all(outward(box)), visit);
    }
    static constexpr std::uint32_t kMostAtOnce = 256;

    /// Two items in two parts, each counted from the first item of its part, in one number.
    class Pair {
    public:
        Pair() = default;
        Pair(std::uint32_t m, std::uint32_t n) : both_(m << 16 | n) {}
        std::uint32_t m() const { return both_ >> 16; }
        std::uint32_t n() const { return both_ & 0xFFFFu; }

    private:
        friend class GridTree;
        std::uint32_t both_;
    };
    /// Pairs of an item in one part and an item in that part or a later one: first_m + pair.m() < first_n + pair.n().
    struct PartPairs {
        std::uint32_t first_m, first_n;
        std::span<const Pair> pairs;
    };
    /// The number of parts into which the pairs of items with meeting boxes are divided, by m.
    std::uint32_t part_count() const { return levels_[part_level()].size(); }
    /// Calls visit(PartPairs) until all pairs of these parts have been visited, with at most 2^18 at once.
    void visit_pairs(std::uint32_t first_part, std::uint32_t end_part,
                     const std::function<void(const PartPairs&)>& visit) const;
    /// Is the order of the items spatial enough to find pairs quickly? Estimated from a sample.
    bool is_spatial() const;

    std::size_t bytes() const;

private:
    /// A group is eight boxes: group g of level 0 holds items 8 g .. 8 g + 7; group g of a higher level holds the
    /// bounding boxes of groups 8 g .. 8 g + 7 of the level below.
    struct Entry {
        std::uint32_t level, group;
    };
    /// Pairs, written without branches: there is room for eight beyond the end.
    class PairList;
    struct PairSearch;

    static constexpr std::uint32_t kBuildGroups = 2048;  // built by one task

    Entry root() const { return {static_cast<std::uint32_t>(levels_.size()) - 1, 0}; }
    void start(std::uint32_t count, const Box& extent);
    void build_upper(std::uint32_t threads);
    /// Groups of a large tree are not in the cache; prefetching lets their misses overlap.
    void prefetch(std::uint32_t level, std::span<const std::uint32_t> groups) const {
        for (const std::uint32_t group : groups) {
            const auto* bytes = reinterpret_cast<const char*>(&levels_[level][group]);
            for (std::size_t line = 0; line < sizeof(Boxes); line += 64) __builtin_prefetch(bytes + line);
        }
    }
    /// Searches these groups of a level and all below them; false where a visit has ended the search.
    template <class Visit>
    bool search_below(std::uint32_t level, std::span<const std::uint32_t> groups, const Boxes& wanted,
                      Visit& visit) const;
    static bool extend(Boxes& boxes, std::uint32_t lane, const GridBox& box);
    /// A part is a group of this level: 8^3 items.
    std::uint32_t part_level() const { return std::min<std::uint32_t>(2, root().level); }
    std::vector<std::uint32_t> parts_near(std::uint32_t part) const;
    void begin_part(std::uint32_t part, PairSearch& search) const;
    void find_pairs(std::uint32_t other, PairSearch& search) const;
    void pair_lanes(std::uint32_t level, PairSearch& search) const;
    /// The first group of a level below a part.
    std::uint32_t first_group(std::uint32_t part, std::uint32_t level) const {
        return part << 3 * (part_level() - level);
    }

    Vec3 origin_;
    double cells_per_length_ = 1;
    std::vector<FlatArray<Boxes>> levels_;
};

template <class BoxOf>
void GridTree::build(std::uint32_t count, const Box& extent, std::uint32_t threads, BoxOf&& box_of) {
    start(count, extent);
    for_each_index(levels_[0].size(), kBuildGroups, threads, [&](std::uint32_t g) {
        Boxes boxes = Boxes::none();
        for (std::uint32_t item = g * kFan; item < std::min(count, (g + 1) * kFan); ++item) {
            const Box box = box_of(item);
            if (!box.is_empty()) boxes.put(item % kFan, outward(box));
        }
        levels_[0][g] = boxes;
    });
    build_upper(threads);
}

/// Level by level, and without branches that depend on single boxes: most would be mispredicted.
template <class Visit>
bool GridTree::search_below(std::uint32_t level, std::span<const std::uint32_t> groups, const Boxes& wanted,
                            Visit& visit) const {
    constexpr std::size_t kGroups = kMostAtOnce / kFan;
    std::array<std::uint32_t, kMostAtOnce> met;
    for (; !groups.empty(); groups = groups.subspan(std::min(kGroups, groups.size()))) {
        std::size_t count = 0;
        for (const std::uint32_t group : groups.first(std::min(kGroups, groups.size()))) {
            const unsigned mask = levels_[level][group].meeting(wanted);
            for (std::uint32_t k = 0; k < kFan; ++k) met[count + k] = group * kFan + kSetBits.bits[mask][k];
            count += kSetBits.count[mask];
        }
        const std::span<const std::uint32_t> found(met.data(), count);
        if (level > 0) prefetch(level - 1, found);
        if (!(level > 0 ? search_below(level - 1, found, wanted, visit) : visit(found))) return false;
    }
    return true;
}

}  // namespace regionmesh
