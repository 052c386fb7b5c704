#include "cells/label_census.h"

#include <algorithm>
#include <bit>

namespace regionmesh {
namespace {

/// Faces inside a tetrahedron by the number of its labels; two labels may be one against three or two against two.
std::uint64_t faces_of(unsigned pattern) {
    switch (std::popcount(pattern)) {
        case 0:
            return 0;
        case 3:
            return 1;
        case 4:
            return 2;
        case 5:
            return 5;
        default:
            return 12;
    }
}

/// Contribution of a node to the Euler characteristic of its region, 2 (N0 - N1 + N2 - N3) of the simplices with this
/// base node and one label: by the set of steps to nodes of that label, step n as bit n - 1.
constexpr std::array<std::int8_t, 128> make_euler_shares() {
    std::array<std::int8_t, 128> shares{};
    for (unsigned set = 0; set < 128; ++set)
        for (const SimplexKind& kind : kKinds) {
            bool is_inside = true;
            for (int n = 1; n < kind.node_count; ++n) is_inside &= (set >> (kind.steps[n] - 1) & 1) != 0;
            if (is_inside) shares[set] += kind.node_count % 2 == 1 ? 2 : -2;
        }
    return shares;
}
constexpr std::array<std::int8_t, 128> kEulerShares = make_euler_shares();

}  // namespace

LabelCensus::LabelCensus(const Lattice& lattice, Sweep sweep, StripOptions options)
    : width_(lattice.size[sweep.axes[0]]),
      height_(lattice.size[sweep.axes[1]]),
      options_(std::move(options)),
      mixed_(width_ - 1) {
    for (int n = 0; n < 3; ++n)
        for (const bool is_high : {false, true})
            sides_ |= unsigned{options_.is_side_of_whole(sweep.axes[n], is_high, lattice.size[sweep.axes[n]])}
                      << (2 * n + is_high);
    if (options_.cells == CellKind::kAuto) options_.cells = CellKind::kCompact;
}

void LabelCensus::add(std::span<const Label> low, std::span<const Label> high, bool is_last) {
    const bool is_capped = options_.cap && (is_first_ || is_last);
    for (std::uint32_t j = 0; j < height_; ++j) {
        if (is_capped || j == 0 || j + 2 >= height_ || width_ < 3) {
            for (std::uint32_t i = 0; i < width_; ++i) look_at(low, high, is_last, i, j);
            continue;
        }
        // Only mixed cells count, and the two ends of the row, which lie on sides of the box.
        const std::size_t row = std::size_t{j} * width_;
        mixed_.find(&low[row], &low[row + width_], &high[row], &high[row + width_]);
        look_at(low, high, is_last, 0, j);
        mixed_.for_each([&](std::uint32_t i) {
            if (i > 0 && i + 2 < width_) look_at(low, high, is_last, i, j);
        });
        for (std::uint32_t i = width_ - 2; i < width_; ++i) look_at(low, high, is_last, i, j);
    }
    is_first_ = false;
}

/// Node i, j of the low section, and the cell that begins there.
void LabelCensus::look_at(std::span<const Label> low, std::span<const Label> high, bool is_last, std::uint32_t i,
                          std::uint32_t j) {
    const bool has_i = i + 1 < width_, has_j = j + 1 < height_;
    const std::size_t a = std::size_t{j} * width_ + i;
    // Beyond the box the node itself is used; `available` has the steps that exist.
    const std::size_t b = a + (has_i ? 1 : 0), row = has_j ? width_ : 0;
    const Corners labels{low[a], low[b], low[a + row], low[b + row], high[a], high[b], high[a + row], high[b + row]};
    Label difference = 0;
    for (Label label : labels) difference |= label ^ labels[0];
    const bool is_last_node = !has_i && !has_j;
    if (difference || is_last_node) {
        const Step plane = (has_i ? 1 : 0) | (has_j ? 2 : 0);
        count_node(labels, plane | 4);
        if (is_last) {
            const Corners top{high[a], high[b], high[a + row], high[b + row],
                              high[a], high[b], high[a + row], high[b + row]};
            count_node(top, plane);
        }
    }
    if (!has_i || !has_j) return;
    if (difference) count_cell(labels);
    if (!options_.cap) return;
    unsigned sides =
        unsigned(i == 0) | unsigned(i + 2 == width_) << 1 | unsigned(j == 0) << 2 | unsigned(j + 2 == height_) << 3;
    sides |= unsigned(is_first_) << 4 | unsigned(is_last) << 5;
    sides &= sides_;
    if (sides) count_caps(labels, sides);
}

/// The simplices whose base node is the cell's first, restricted to the steps that stay in the box.
void LabelCensus::count_node(const Corners& labels, Step available) {
    const Label own = labels[0];
    unsigned same = 0;  // steps to nodes with this label
    for (Step step = 1; step < 8; ++step) {
        if ((step & available) != step) continue;
        if (labels[step] == own)
            same |= 1u << (step - 1);
        else
            pairs_.add(own, labels[step]);
    }
    if (own >= euler_.size()) euler_.resize(own + 1, 0);
    euler_[own] += kEulerShares[same];
}

void LabelCensus::count_cell(const Corners& labels) {
    const bool is_compact = options_.cells == CellKind::kCompact;
    if (is_compact) {
        const CompactCells::Counts counts = CompactCells::get().counts(labels);
        faces_ += counts.faces;
        if (counts.labels < 4) return;
    }
    for (int t = kFirstTetrahedron; t < kKindCount; ++t) {
        const auto& step = kKinds[t].steps;
        const unsigned pattern = tetrahedron_pattern(labels[0], labels[step[1]], labels[step[2]], labels[7]);
        if (!is_compact) faces_ += faces_of(pattern);
        quadruple_points_ += pattern == 63;
    }
}

void LabelCensus::count_caps(const Corners& labels, unsigned sides) {
    for (int side = 0; side < 6; ++side) {
        if (!(sides >> side & 1)) continue;
        const auto corner = labels_at(labels, corners_of_side(side));
        if (options_.cells == CellKind::kCompact && drops_diagonal(corner)) {
            for (const CaseFace& face : compact_cap(corner)) count_face(corner[face.first], 1);
            continue;
        }
        count_triangle(corner[0], corner[1], corner[3]);
        count_triangle(corner[0], corner[2], corner[3]);
    }
}

/// A corner alone gives one face with its label; two corners with the same label give two, three give one.
void LabelCensus::count_triangle(Label a, Label b, Label c) {
    if (a == b && b == c) return count_face(a, 1);
    if (a != b && b != c && a != c) return count_face(a, 2), count_face(b, 2), count_face(c, 2);
    const Label twin = a == b || a == c ? a : b;
    const Label tip = a == b ? c : a == c ? b : a;
    count_face(twin, 2);
    count_face(tip, 1);
}

LabelOracle LabelCensus::oracle() const { return {euler_, quadruple_points_, pairs_.size()}; }

}  // namespace regionmesh
