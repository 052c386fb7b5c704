// Boxes of dense labels out of a volume, in any order.
#pragma once

#include <memory>
#include <span>

#include "regionmesh/label.h"
#include "regionmesh/lattice.h"

namespace regionmesh {

/// The sections of one box, one after the other as the volume is swept.
class BoxSections {
public:
    virtual ~BoxSections() = default;

    /// Fills `section` with the next one; axes[0] of the sweep is fastest. Throws Error(kInput).
    virtual void next(std::span<Label> section) = 0;
};

/// Labels are those of one table for the whole volume, numbered in the order in which sections have them.
class LabelBoxes {
public:
    virtual ~LabelBoxes() = default;

    /// Requires that this outlives the sections.
    virtual std::unique_ptr<BoxSections> open(const IndexBox& box) const = 0;
};

}  // namespace regionmesh
