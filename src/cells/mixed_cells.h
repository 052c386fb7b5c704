// Finds the cells of a row that have more than one label.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "regionmesh/label.h"

namespace regionmesh {

/// The cells of a row whose eight labels are not all the same: few of the cells of most volumes.
class MixedCells {
public:
    explicit MixedCells(std::uint32_t cells) : cells_(cells), mixed_((cells + 7) / 8 * 8, 0) {}

    /// a, b, c, d are the four rows of samples round the cells, each one sample longer than the row of cells. A plain
    /// loop of ors, which compilers vectorise.
    void find(const Label* a, const Label* b, const Label* c, const Label* d) {
        for (std::uint32_t i = 0; i < cells_; ++i) {
            const Label x = a[i];
            mixed_[i] = ((x ^ a[i + 1]) | (x ^ b[i]) | (x ^ b[i + 1]) | (x ^ c[i]) | (x ^ c[i + 1]) | (x ^ d[i]) |
                         (x ^ d[i + 1])) != 0;
        }
    }

    /// Calls visit(i) for each mixed cell, in order. Skips eight cells at a time.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::uint32_t first = 0; first < cells_; first += 8) {
            std::uint64_t eight = 0;
            std::memcpy(&eight, &mixed_[first], 8);
            if (eight == 0) continue;
            for (std::uint32_t i = first; i < first + 8; ++i)
                if (mixed_[i]) visit(i);
        }
    }

private:
    std::uint32_t cells_;
    std::vector<std::uint8_t> mixed_;  // filled up to a multiple of eight
};

}  // namespace regionmesh
