// Where a merged vertex goes, and what that costs: one policy for ranking and collapse.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "judge/judge.h"
#include "regionmesh/simplify.h"

namespace regionmesh {

/// The cost of an edge, a squared length times an area; the weight that the cost is a sum over, so that cost / weight
/// is a mean squared distance; and the key that the edge is ranked by, which draws short edges forward.
struct EdgeCost {
    float cost, weight, rank;
};

/// The same for a vertex that goes to a neighbour, which stays where it is.
struct HalfCost {
    double cost, weight;

    /// `max_error` is a distance: the bound on the mean squared distance is its square.
    bool is_within(double max_cost, double max_error) const {
        return cost <= max_cost && !(cost > max_error * max_error * weight);
    }
};

/// One instance serves one mesh from its first collapse to its last. Calls come from one thread, except where
/// ranks_in_parallel().
class Placement {
public:
    virtual ~Placement() = default;

    /// Costs of the edges from v to each of `to`, in floats: to rank by. `costs` gets a multiple of four.
    virtual void rank(const Mesh& mesh, VertexId v, std::span<const VertexId> to, std::vector<EdgeCost>& costs) = 0;
    /// True if several threads may call rank(), rank_halves() and place() at a time.
    virtual bool ranks_in_parallel() const { return false; }

    /// Costs where v goes to each of `to`.
    virtual void rank_halves(const Mesh& mesh, VertexId v, std::span<const VertexId> to,
                             std::vector<HalfCost>& costs) = 0;

    /// Where the merged vertex of a star goes (gather). On sides of the box it keeps the coordinates of `stays`, and in
    /// a star that lies in a plane square to an axis it keeps that coordinate.
    virtual Places place(const Mesh& mesh, const EdgeStar& star) = 0;

    /// The star is about to be collapsed to `position`.
    virtual void collapse(const Mesh& mesh, const EdgeStar& star, Vec3 position) = 0;

    /// Cost up to which the prepass collapses, in units of scale^4.
    virtual double prepass_cost() const = 0;

    virtual std::size_t bytes() const = 0;
};

/// On a flat star every place in its plane has the same cost: the average of the link often leaves better faces (P
/// quality test 2). Coordinates on sides of the box stay.
Vec3 average_of_link(const Mesh& mesh, const EdgeStar& star);

/// Requires the label counts of the vertices (count_labels). On at most `threads` threads (0: one per core).
std::unique_ptr<Placement> make_placement(const Mesh& mesh, const SimplifyOptions& options, std::uint32_t threads = 1);

/// The rows of the table in placement.cpp; each is one file.
std::unique_ptr<Placement> make_quadric_placement(const Mesh& mesh, const SimplifyOptions& options,
                                                  std::uint32_t threads);
std::unique_ptr<Placement> make_lindstrom_turk_placement(const Mesh& mesh, const SimplifyOptions& options,
                                                         std::uint32_t threads);

}  // namespace regionmesh
