// The range along the sweep in which faces may change now.
#pragma once

#include <cmath>

namespace regionmesh {

/// Faces of earlier chunks reach up to `low` along the sweep at most, and faces to come reach down to `high` at most,
/// so that a change strictly between them meets neither.
struct SafeInterval {
    double low = -HUGE_VAL, high = HUGE_VAL;
};

}  // namespace regionmesh
