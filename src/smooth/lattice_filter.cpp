#include "smooth/lattice_filter.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "smooth/lattice_level.h"
#include "smooth/lattice_lines.h"

namespace regionmesh {
namespace {

/// Sizes of blocks in units of the finest spacing. Terraces are as many samples wide as sections are far apart, for the
/// same slope, so anisotropic lattices start one scale coarser.
constexpr double kSmallest = 2, kLargest = 8, kLargestAnisotropic = 16;
constexpr double kAnisotropic = 2;

double largest_block(const LatticeFrame& frame, double reach) {
    if (reach > 0) return reach;
    const double coarsest = std::max({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    return coarsest < kAnisotropic * frame.finest() ? kLargest : kLargestAnisotropic;
}

NearestPoint nearest_to_interfaces(const LatticeSites& found, std::span<const SiteEstimate> estimates,
                                   std::uint32_t vertex, const SimplexEdges& edges) {
    NearestPoint nearest{edges.count};
    for (std::uint32_t s = found.first[vertex]; s != kNoSite; s = found.next[s])
        if (estimates[s].rest < 1 && length2(estimates[s].slope) > 0) nearest.add(estimates[s], edges);
    return nearest;
}

}  // namespace

std::vector<Vec3> lattice_positions(std::span<const Vec3> positions, std::span<const LatticeFace> faces,
                                    const LatticeFrame& frame, const LatticeFilterOptions& options) {
    std::vector<LatticeSimplex> simplices(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v) simplices[v] = simplex_of(positions[v], frame);
    const LatticeSites found = find_sites(positions, simplices, faces);
    std::vector<SiteEstimate> estimates(found.sites.size());
    const double finest = frame.finest();
    for (double size = largest_block(frame, options.reach); size >= kSmallest; size /= 2) {
        LatticeLevel level(found.sites, frame,
                           {.size = size * finest, .takes_all = size / 2 < kSmallest, .threads = options.threads});
        level.refine(estimates);
    }
    std::vector<Vec3> result(positions.begin(), positions.end());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        if (found.first[v] == kNoSite || simplices[v].kind == 0) continue;
        const SimplexEdges edges = edges_of(simplices[v].kind, frame.spacing);
        const Barycentric weights = weights_of(nearest_to_interfaces(found, estimates, v, edges));
        result[v] = position_in(simplices[v], clamp_inside(weights, edges.count + 1, options.margin), frame);
    }
    LatticeLines lines(simplices, faces);
    for (LatticeLines::Node& node : lines.nodes()) {
        const SimplexEdges edges = edges_of(simplices[node.vertex].kind, frame.spacing);
        node.nearest = nearest_to_interfaces(found, estimates, node.vertex, edges);
        node.centroid = positions[node.vertex];
    }
    lines.fair(result, simplices, frame, options.margin);
    return result;
}

}  // namespace regionmesh
