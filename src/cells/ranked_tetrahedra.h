// Tetrahedra and their points, sorted along the sweep (P 3.9).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/external_sort.h"
#include "regionmesh/label.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/limits.h"
#include "regionmesh/tetrahedron_reader.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Points by rank: sorted by position along the sweep, then by the other coordinates. Points at the same position are
/// one point.
struct RankedPoints {
    struct Other {
        std::uint32_t point;
        InputLabel label;
    };

    Sweep sweep;
    std::vector<Vec3> positions;
    std::vector<Label> labels;                        // dense; empty where the tetrahedra have labels
    std::vector<std::uint32_t> points;                // the reader's numbers; of points at one position the first
    std::unordered_map<std::uint32_t, Other> others;  // key: rank; a point at that position with another label
    Box box;                                          // box of the points that tetrahedra use

    std::uint32_t size() const { return static_cast<std::uint32_t>(positions.size()); }
    double along(std::uint32_t rank) const { return positions[rank][sweep.axes[2]]; }
};

/// Sorted by their lowest corners.
struct RankedTetrahedron {
    std::array<std::uint32_t, 4> corners;  // ranks, increasing
    Label label : 31;                      // dense, where tetrahedra have labels
    std::uint32_t is_mirrored : 1;         // orientation() < 0 in the order of ranks

    friend bool operator<(const RankedTetrahedron& a, const RankedTetrahedron& b) { return a.corners < b.corners; }
};

struct RankedTetrahedra {
    RankedPoints points;
    ExternalSort<RankedTetrahedron> sorted;
    double six_volumes = 0;  // six times the total volume

    /// Edge length of a cube that six average tetrahedra fill. Equals the spacing where they come from a lattice.
    double spacing() const;
};

struct RankOptions {
    std::optional<Sweep> sweep = {};                     // default: along the longest side of the box round all points
    std::uint64_t sort_bytes = std::uint64_t{64} << 20;  // bytes for sorting, in addition to the points
    std::uint64_t memory = kDefaultMemory;               // bytes that points may take
};

/// Reads all points and tetrahedra; labels of points get their dense numbers in the order of ranks. Throws
/// Error(kInput) for two labels at one position of a tetrahedron (both points are named), for a tetrahedron that is
/// flat or has corners that do not exist, for more points than memory holds, and where no tetrahedron has a volume
/// above rounding.
RankedTetrahedra rank_tetrahedra(TetrahedronReader& reader, LabelTable& labels, const RankOptions& options = {});

}  // namespace regionmesh
