// Boxes of dense labels out of a volume, in any order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blocks/block_grid.h"
#include "regionmesh/label.h"
#include "regionmesh/lattice.h"

namespace regionmesh {

/// Labels are those of one table for the whole volume, numbered in the order in which sections have them.
class LabelBoxes {
public:
    virtual ~LabelBoxes() = default;

    /// Fills `section` with the samples of the box in section `number` of the volume; axes[0] of the sweep is fastest.
    /// Threads may call it at the same time.
    virtual void read(const IndexBox& box, std::uint32_t number, std::span<Label> section) const = 0;
};

}  // namespace regionmesh
