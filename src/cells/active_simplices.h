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

    /// Index of the simplex, for its note; a default note where there was none.
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
    Simplex& operator[](std::uint32_t item) { return simplices_[item]; }

    /// Calls visit(simplex) for all whose lowest corner is `rank`; the visit may add others, of higher corners.
    template <class Visit>
    void for_lowest(std::uint32_t rank, Visit&& visit) {
        if (rank >= heads_.end()) return;
        for (std::uint32_t item = heads_[rank]; item != kNone;) {
            const std::uint32_t next = simplices_[item].next;
            visit(item);
            item = next;
        }
    }

    /// Releases all simplices whose lowest corner is `rank`. Ranks are released in order.
    void drop(std::uint32_t rank) {
        if (rank >= heads_.end()) heads_.grow(rank + 1, kNone);
        for (std::uint32_t item = heads_[rank]; item != kNone;) {
            const std::uint32_t next = simplices_[item].next;
            erase(item);
            simplices_[item].next = free_;
            free_ = item;
            item = next;
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
        std::uint32_t item = free_;
        if (item == kNone) {
            item = static_cast<std::uint32_t>(simplices_.size());
            simplices_.emplace_back();
        } else {
            free_ = simplices_[item].next;
        }
        if (corners[0] >= heads_.end()) heads_.grow(corners[0] + 1, kNone);
        simplices_[item] = {corners, heads_[corners[0]], Note{}};
        heads_[corners[0]] = item;
        ++used_;
        return item;
    }

    /// Moves up the entries behind it, so that no gap separates them from their first slot.
    void erase(std::uint32_t item) {
        std::size_t gap = first_slot(simplices_[item].corners);
        while (table_[gap] != item) gap = (gap + 1) & mask();
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
        for (std::uint32_t item : old) {
            if (item == kNone) continue;
            std::size_t at = first_slot(simplices_[item].corners);
            while (table_[at] != kNone) at = (at + 1) & mask();
            table_[at] = item;
        }
    }

    std::vector<std::uint32_t> table_;  // items, a power of two of them
    std::vector<Simplex> simplices_;
    std::uint32_t free_ = kNone;
    std::uint32_t used_ = 0;
    SlidingArray<std::uint32_t> heads_;  // one per rank
};

}  // namespace regionmesh
