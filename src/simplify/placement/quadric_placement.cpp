#include "mesh/strata.h"
#include "simplify/placement/placement.h"
#include "simplify/rank/edge_costs.h"
#include "simplify/tuning.h"

namespace regionmesh {
namespace {

/// Least sum of squared distances to the planes gathered (Garland and Heckbert 1997); on a flat star the average of the
/// link is the second place (P quality test 2).
class QuadricPlacement final : public Placement {
public:
    QuadricPlacement(const Mesh& mesh, std::uint32_t threads) : quadrics_(mesh, threads) {}

    void rank(const Mesh& mesh, VertexId v, std::span<const VertexId> to, std::vector<EdgeCost>& costs) override {
        find_edge_costs(mesh, quadrics_, v, to, costs);
    }
    bool ranks_in_parallel() const override { return true; }
    void rank_halves(const Mesh& mesh, VertexId v, std::span<const VertexId> to,
                     std::vector<HalfCost>& costs) override {
        const Quadric own = quadrics_[v].unpack();
        costs.clear();
        for (VertexId w : to) {
            const PackedQuadric& other = quadrics_[w];
            costs.push_back(
                {own.at(mesh.position(w) - mesh.position(v)) + other.c, own.weight() + other.xx + other.yy + other.zz});
        }
    }
    Places place(const Mesh& mesh, const EdgeStar& star) override;
    void collapse(const Mesh& mesh, const EdgeStar& star, Vec3 position) override {
        quadrics_.merge(mesh, star.goes, star.stays, position);
    }
    double prepass_cost() const override { return kPrepassCost; }
    std::size_t bytes() const override { return quadrics_.bytes(); }

private:
    VertexQuadrics quadrics_;
};

bool is_flat(const EdgeEnds& edge, double cost) {
    const double weight = edge.goes_quadric.unpack().weight() + edge.stays_quadric.unpack().weight();
    return cost <= kFlat * weight * length2(edge.goes - edge.stays);
}

Places QuadricPlacement::place(const Mesh& mesh, const EdgeStar& star) {
    const EdgeEnds edge = quadrics_.ends(mesh, star.goes, star.stays);
    const LeastCost least = least_cost(edge);
    Places places{star.kept_level(least.position)};
    if (!is_flat(edge, least.cost)) return places;
    const Vec3 average = star.kept_level(average_of_link(mesh, star));
    if (is_flat(edge, cost_at(edge, average))) places.second = average;
    return places;
}

}  // namespace

std::unique_ptr<Placement> make_quadric_placement(const Mesh& mesh, const SimplifyOptions&, std::uint32_t threads) {
    return std::make_unique<QuadricPlacement>(mesh, threads);
}

}  // namespace regionmesh
