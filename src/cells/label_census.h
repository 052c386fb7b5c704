// Counts on the labels alone, section by section: the invariants of the mesh, and its number of faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells/label_pairs.h"
#include "cells/mixed_cells.h"
#include "cells/strip_mesher.h"
#include "regionmesh/label.h"
#include "regionmesh/label_oracle.h"

namespace regionmesh {

/// The Euler characteristic of region r's boundary is 2 (N0 - N1 + N2 - N3), where Ni counts the i-simplices of Kuhn's
/// lattice whose corners all have label r. At a node whose cell has one label they cancel, so only mixed cells are
/// visited. Faces are counted by case, without making them.
class LabelCensus {
public:
    /// A part of a volume (StripOptions::first): only faces are counted rightly.
    LabelCensus(const Lattice& lattice, Sweep sweep, StripOptions options);

    /// Counts the strip between two consecutive sections; `is_last` when `high` is the last section.
    void add(std::span<const Label> low, std::span<const Label> high, bool is_last);

    /// Faces before simplification, so far.
    std::uint64_t face_count() const { return faces_; }
    LabelOracle oracle() const;

private:
    using Corners = std::array<Label, 8>;

    void look_at(std::span<const Label> low, std::span<const Label> high, bool is_last, std::uint32_t i,
                 std::uint32_t j);
    void count_cell(const Corners& labels);
    void count_node(const Corners& labels, Step available);
    void count_caps(const Corners& labels, unsigned sides);
    void count_triangle(Label a, Label b, Label c);
    void count_face(Label label, std::uint64_t faces) {
        if (!options_.is_background(label)) faces_ += faces;
    }

    std::uint32_t width_, height_;
    StripOptions options_;
    unsigned sides_ = 0;  // bits of sides of the whole volume: axes of the sweep, low and high
    MixedCells mixed_;    // mixed cells of a row
    bool is_first_ = true;
    std::uint64_t faces_ = 0;
    std::uint64_t quadruple_points_ = 0;
    std::vector<std::int64_t> euler_;
    LabelPairs pairs_;
};

}  // namespace regionmesh
