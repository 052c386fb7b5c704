// The closed surfaces round the pieces of each region, and the test whether one was turned inside out.
#pragma once

#include <cstdint>
#include <vector>

#include "smooth/surface_window.h"

namespace regionmesh {

/// A shell is the set of the sides of faces that look into one piece of one region. Its signed volume may change, its
/// sign may not: a flat shell can turn inside out in one step in which no face turns over, none crosses another, and no
/// other part of the surface is touched. Pieces that touch in a vertex count as one. Open shells are left out.
class Shells {
public:
    /// Of all faces of a window that holds the whole surface, at their origins.
    explicit Shells(const SurfaceWindow& window);

    /// The faces of all shells whose volume has changed its sign, or vanished, at these positions; ascending.
    std::vector<std::uint32_t> inverted(const SurfaceWindow& window, const SlidingArray<Vec3>& positions) const;

private:
    /// Six times the volumes.
    std::vector<double> volumes(const SurfaceWindow& window, const SlidingArray<Vec3>& positions) const;
    void join(const SurfaceWindow& window);
    void note_closed(const SurfaceWindow& window);

    std::vector<std::uint32_t> shell_;   // shell of each side of each face: 2 * face + side
    std::vector<std::uint32_t> corner_;  // one per shell: a vertex, from which volumes are measured
    std::vector<bool> is_closed_;        // one per shell
    std::vector<double> before_;         // one per shell: six times the volume at the origins; 0 if open
};

}  // namespace regionmesh
