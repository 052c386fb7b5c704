// Which boxes are near? A tree of boxes with 16-bit coordinates, eight of which are compared at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/parallel_for.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// An eight-fold tree over the places 0 .. count - 1 of a list of boxes, whose order should be a spatial one. Boxes are
/// rounded outward to 1/65535 of the whole extent, two bytes a coordinate: 14 bytes a place all told.
class GridTree {
public:
    static constexpr std::uint32_t kFan = 8;

    /// A box in cells of the grid.
    struct GridBox {
        std::int16_t low[3];
        std::int16_t high[3];
    };
    /// Eight boxes side by side.
    struct alignas(16) Boxes {
        std::int16_t low[3][kFan];
        std::int16_t high[3][kFan];

        /// Boxes that meet nothing.
        static Boxes none();
        GridBox operator[](std::uint32_t lane) const;
        void put(std::uint32_t lane, const GridBox& box);
        /// The smallest box round all eight.
        GridBox hull() const;
        /// Bit n is set when box n meets `box`.
        unsigned meeting(const GridBox& box) const;
    };

    /// Begins again; the old boxes are let go first. box_of(n), called on several threads, is the box at place n, empty
    /// where there is none; `extent` is the box round them all.
    template <class BoxOf>
    void build(std::uint32_t count, const Box& extent, std::uint32_t threads, BoxOf&& box_of);

    /// The smallest box of the grid round `box`, and a little more.
    GridBox outward(const Box& box) const;

    /// What is at the place now lies in `box`. The boxes above it grow, and never shrink.
    void set(std::uint32_t place, const Box& box);
    /// The place is empty.
    void remove(std::uint32_t place);

    /// Calls visit(place, GridBox) for every place whose rounded box, which is given, meets `box`. A visit that returns
    /// false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const;

    /// Two places, m < n, in one number: several are written at once.
    class Pair {
    public:
        Pair() = default;
        Pair(std::uint32_t m, std::uint32_t n) : both_(std::uint64_t{n} << 32 | m) {}
        std::uint32_t m() const { return static_cast<std::uint32_t>(both_); }
        std::uint32_t n() const { return static_cast<std::uint32_t>(both_ >> 32); }

    private:
        friend class GridTree;
        explicit Pair(std::uint64_t both) : both_(both) {}
        std::uint64_t both_;
    };
    /// All pairs of places whose rounded boxes meet come in so many parts, by m.
    std::uint32_t part_count() const { return levels_[part_level()].size; }
    /// Calls visit(span<const Pair>) until all pairs of the part have been visited, with at most 2^18 at once.
    void visit_pairs(std::uint32_t part, const std::function<void(std::span<const Pair>)>& visit) const;
    /// Is the order of the places so spatial that pairs are found quickly? Judged from a sample.
    bool is_spatial() const;

    std::size_t bytes() const;

private:
    /// A group is eight boxes: group g of level 0 holds places 8 g .. 8 g + 7, and of the others those of groups
    /// 8 g .. 8 g + 7 of the level below.
    struct Entry {
        std::uint32_t level, group;
    };
    /// Pairs, written without looking: there is room for eight beyond the end.
    class PairList;
    struct PairSearch;

    /// Made without touching the memory.
    struct Level {
        std::uint32_t size;
        std::unique_ptr<Boxes[]> groups;
        Boxes& operator[](std::uint32_t group) const { return groups[group]; }
    };
    static constexpr std::uint32_t kBuildGroups = 2048;  // built by a task

    Entry root() const { return {static_cast<std::uint32_t>(levels_.size()) - 1, 0}; }
    void start(std::uint32_t count, const Box& extent);
    void build_upper(std::uint32_t threads);
    static bool extend(Boxes& boxes, std::uint32_t lane, const GridBox& box);
    /// A part is a group of this level: 8^3 places.
    std::uint32_t part_level() const { return std::min<std::uint32_t>(2, root().level); }
    std::vector<std::uint32_t> parts_near(std::uint32_t part) const;
    void find_pairs(std::uint32_t part, std::uint32_t other, PairSearch& search) const;
    void pair_lanes(std::uint32_t level, PairSearch& search) const;

    Vec3 origin_;
    double cells_per_length_ = 1;
    std::vector<Level> levels_;
};

template <class BoxOf>
void GridTree::build(std::uint32_t count, const Box& extent, std::uint32_t threads, BoxOf&& box_of) {
    start(count, extent);
    const std::uint32_t groups = levels_[0].size;
    parallel_for(groups / kBuildGroups + 1, threads, [&](std::uint32_t task) {
        for (std::uint32_t g = task * kBuildGroups; g < std::min(groups, (task + 1) * kBuildGroups); ++g) {
            Boxes boxes = Boxes::none();
            for (std::uint32_t place = g * kFan; place < std::min(count, (g + 1) * kFan); ++place) {
                const Box box = box_of(place);
                if (!box.is_empty()) boxes.put(place % kFan, outward(box));
            }
            levels_[0][g] = boxes;
        }
    });
    build_upper(threads);
}

template <class Visit>
void GridTree::search(const Box& box, Visit&& visit) const {
    const GridBox wanted = outward(box);
    Entry stack[128];
    int top = 0;
    stack[top++] = root();
    while (top > 0) {
        const Entry entry = stack[--top];
        const Boxes& boxes = levels_[entry.level][entry.group];
        for (unsigned mask = boxes.meeting(wanted); mask; mask &= mask - 1) {
            const std::uint32_t lane = static_cast<std::uint32_t>(__builtin_ctz(mask)),
                                child = entry.group * kFan + lane;
            if (entry.level > 0)
                stack[top++] = {entry.level - 1, child};
            else if (!visit(child, boxes[lane]))
                return;
        }
    }
}

}  // namespace regionmesh
