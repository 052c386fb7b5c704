#include "cells/compact_cells.h"

#include <cassert>

namespace regionmesh {
namespace {

constexpr std::string_view kTable =
#include "cells/compact_table.inc"
    ;

// Edges of a side by their corners.
constexpr CornerSet k01 = 0b0011, k02 = 0b0101, k13 = 0b1010, k23 = 0b1100;
constexpr CornerSet k0 = 0b0001, k1 = 0b0010, k2 = 0b0100, k3 = 0b1000;

int label_count_of(const Partition& partition) {
    int count = 0;
    for (std::uint8_t n = 0; n < 8; ++n) count += partition[n] == n;
    return count;
}

}  // namespace

const std::array<std::array<CaseFace, 4>, 4> kCompactCaps{{
    {{{{k0, k1, k13}, 0, 0}, {{k0, k13, k23}, 0, 0}, {{k0, k23, k2}, 0, 0}, {{k13, k3, k23}, 3, 3}}},
    {{{{k0, k01, k23}, 0, 0}, {{k0, k23, k2}, 0, 0}, {{k01, k1, k3}, 3, 3}, {{k01, k3, k23}, 3, 3}}},
    {{{{k0, k1, k13}, 0, 0}, {{k0, k13, k02}, 0, 0}, {{k02, k13, k3}, 3, 3}, {{k02, k3, k2}, 3, 3}}},
    {{{{k0, k01, k02}, 0, 0}, {{k01, k1, k3}, 3, 3}, {{k01, k3, k02}, 3, 3}, {{k02, k3, k2}, 3, 3}}},
}};

const std::array<CaseFace, 4>& compact_cap(const std::array<Label, 4>& labels) {
    return kCompactCaps[unsigned(labels[1] == labels[3]) | unsigned(labels[2] == labels[3]) << 1];
}

CompactCells::CompactCells() : entries_(kPartitionNumbers) {
    for (std::size_t s = 0; s < kCellSymmetries.size(); ++s) {
        const CellSymmetry& symmetry = kCellSymmetries[s];
        for (int n = 0; n < kCellSimplexCount; ++n)
            images_[s].vertex[n] = static_cast<std::uint8_t>(place_in_cell(symmetry(kCellSimplices[n])));
        images_[s].node = symmetry.node;
        images_[s].mirrors = symmetry.mirrors;
    }
    std::vector<bool> is_known(kPartitionNumbers, false);
    std::size_t at = 0;
    const auto next = [&] { return static_cast<std::uint8_t>(kCompactAlphabet.find(kTable[at++])); };
    for_each_partition([&](const Partition& labels) {
        if (is_known[number_of(labels)]) return;
        const auto first = static_cast<std::uint32_t>(faces_.size());
        while (kTable[at] != kEndOfClass) {
            CompactFace& face = faces_.emplace_back();
            for (std::uint8_t& vertex : face.vertices) vertex = next();
            const std::uint8_t nodes = next();
            face.first = nodes / 8;
            face.second = nodes % 8;
        }
        ++at;
        const auto count = static_cast<std::uint16_t>(faces_.size() - first);
        const auto label_count = static_cast<std::uint8_t>(label_count_of(labels));
        for (std::uint8_t s = 0; s < kCellSymmetries.size(); ++s) {
            const int number = number_of(kCellSymmetries[s](labels));
            if (!is_known[number]) entries_[number] = {first, count, s, label_count};
            is_known[number] = true;
        }
    });
    assert(at == kTable.size());
    for (unsigned others = 0; others < two_labels_.size(); ++others) {
        std::array<Label, 8> labels{};
        for (int n = 1; n < 8; ++n) labels[n] = others >> (n - 1) & 1;
        two_labels_[others] = entries_[number_of(partition_of(labels))];
    }
}

const CompactCells& CompactCells::get() {
    static const CompactCells cells;
    return cells;
}

}  // namespace regionmesh
