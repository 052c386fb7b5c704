// Tetrahedra and their points in the order in which the sweep meets them (P 3.9).
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
#include "regionmesh/tetrahedron_reader.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Points by rank: in order of their places along the sweep, then of the other coordinates. All that lie at one place
/// are one.
struct RankedPoints {
    struct Other {
        std::uint32_t point;
        InputLabel label;
    };

    Sweep sweep;
    std::vector<Vec3> positions;
    std::vector<Label> labels;                        // dense; none where the tetrahedra have them
    std::vector<std::uint32_t> points;                // the reader's numbers; of several at one place the first
    std::unordered_map<std::uint32_t, Other> others;  // by rank: a point there with another label
    Box box;                                          // round those that tetrahedra have

    std::uint32_t size() const { return static_cast<std::uint32_t>(positions.size()); }
    double along(std::uint32_t rank) const { return positions[rank][sweep.axes[2]]; }
};

/// In order of their lowest corners.
struct RankedTetrahedron {
    std::array<std::uint32_t, 4> corners;  // ranks, increasing
    Label label : 31;                      // dense, where tetrahedra have them
    std::uint32_t is_mirrored : 1;         // orientation() < 0 in the order of ranks

    friend bool operator<(const RankedTetrahedron& a, const RankedTetrahedron& b) { return a.corners < b.corners; }
};

struct RankedTetrahedra {
    RankedPoints points;
    ExternalSort<RankedTetrahedron> sorted;
    double six_volumes = 0;  // of all of them together, six times

    /// Length of the edge of a cube that six of them fill: the spacing, where they are those of a lattice.
    double spacing() const;
};

struct RankOptions {
    std::optional<Sweep> sweep = {};  // along the longest side of the box round all points if not given
    std::uint64_t sort_bytes = std::uint64_t{64} << 20;  // held beside the points
    std::uint64_t memory = std::uint64_t{2} << 30;       // that points may take
};

/// Takes all that a reader has; labels of points get their numbers in the order of ranks. Throws Error(kInput): naming
/// both points of two labels at one place of a tetrahedron, a tetrahedron that is flat or has corners that are not
/// there; for more points than memory can hold; where there are no tetrahedra, or none that has a volume in numbers.
RankedTetrahedra rank_tetrahedra(TetrahedronReader& reader, LabelTable& labels, const RankOptions& options = {});

}  // namespace regionmesh
