// The active nodes, edges and triangles: those that tetrahedra to come may share.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "base/sliding_array.h"
#include "regionmesh/ids.h"

namespace regionmesh {

/// Ranks of the corners of a node, an edge or a triangle, in increasing order; kNoRank where there are fewer.
using SimplexKey = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t kNoRank = 0xFFFFFFFFu;

/// Notes by simplex: a hash table with open addressing over the corners. Simplices are released by their lowest corner,
/// in order, so the bytes held are proportional to the width of the active set.
template <class Note>
class ActiveSimplices {
public:
    struct Simplex {
        SimplexKey corners;
        std::uint32_t next;  // next item with the same lowest corner, or next free item
        Note note;
    };

    /// The place of the note of a simplex; a default note where there was none.
    std::uint32_t find_or_add(const SimplexKey& corners, bool* is_new = nullptr) {
        if (2 * (used_ + 1) > table_.size()) grow();
        std::size_t at = first_slot(corners);
        while (table_[at] != kNone) {
            if (is_same(simplices_[table_[at]].corners, corners)) {
                if (is_new) *is_new = false;
                return table_[at];
            }
            at = (at + 1) & mask();
        }
        if (is_new) *is_new = true;
        return table_[at] = add(corners);
    }
    Simplex& operator[](std::uint32_t place) { return simplices_[place]; }

    /// Calls visit(simplex) for all whose lowest corner is `rank`; the visit may add others, of higher corners.
    template <class Visit>
    void for_lowest(std::uint32_t rank, Visit&& visit) {
        if (rank >= heads_.end()) return;
        for (std::uint32_t place = heads_[rank]; place != kNone;) {
            const std::uint32_t next = simplices_[place].next;
            visit(place);
            place = next;
        }
    }

    /// Releases all simplices whose lowest corner is `rank`. Ranks are released in order.
    void drop(std::uint32_t rank) {
        if (rank >= heads_.end()) heads_.grow(rank + 1, kNone);
        for (std::uint32_t place = heads_[rank]; place != kNone;) {
            const std::uint32_t next = simplices_[place].next;
            erase(place);
            simplices_[place].next = free_;
            free_ = place;
            place = next;
        }
        heads_.drop_before(rank + 1);
    }

    std::size_t bytes() const {
        return table_.size() * sizeof(std::uint32_t) + simplices_.capacity() * sizeof(Simplex) + heads_.bytes();
    }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    /// Faster than the comparison of arrays, which calls the C library.
    static bool is_same(const SimplexKey& a, const SimplexKey& b) {
        return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
    }

    std::size_t mask() const { return table_.size() - 1; }
    std::size_t first_slot(const SimplexKey& k) const {
        const std::uint64_t high = std::uint64_t{k[0]} << 32 | k[1];
        return (mix64(high) ^ k[2] * 0x9E3779B97F4A7C15ull >> 17) & mask();
    }

    std::uint32_t add(const SimplexKey& corners) {
        std::uint32_t place = free_;
        if (place == kNone) {
            place = static_cast<std::uint32_t>(simplices_.size());
            simplices_.emplace_back();
        } else {
            free_ = simplices_[place].next;
        }
        if (corners[0] >= heads_.end()) heads_.grow(corners[0] + 1, kNone);
        simplices_[place] = {corners, heads_[corners[0]], Note{}};
        heads_[corners[0]] = place;
        ++used_;
        return place;
    }

    /// Moves up the entries behind it, so that no gap separates them from their first slot.
    void erase(std::uint32_t place) {
        std::size_t gap = first_slot(simplices_[place].corners);
        while (table_[gap] != place) gap = (gap + 1) & mask();
        for (std::size_t at = (gap + 1) & mask(); table_[at] != kNone; at = (at + 1) & mask()) {
            const std::size_t first = first_slot(simplices_[table_[at]].corners);
            if (((at - first) & mask()) < ((at - gap) & mask())) continue;
            table_[gap] = table_[at];
            gap = at;
        }
        table_[gap] = kNone;
        --used_;
    }

    void grow() {
        std::vector<std::uint32_t> old(std::max<std::size_t>(table_.size() * 2, 1024), kNone);
        old.swap(table_);
        for (std::uint32_t place : old) {
            if (place == kNone) continue;
            std::size_t at = first_slot(simplices_[place].corners);
            while (table_[at] != kNone) at = (at + 1) & mask();
            table_[at] = place;
        }
    }

    std::vector<std::uint32_t> table_;  // places, a power of two of them
    std::vector<Simplex> simplices_;
    std::uint32_t free_ = kNone;
    std::uint32_t used_ = 0;
    SlidingArray<std::uint32_t> heads_;  // one per rank
};

}  // namespace regionmesh
