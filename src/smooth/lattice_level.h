// One scale of the lattice filter: overlapping quadrics that explain the labels near their centres.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smooth/lattice_quadric.h"
#include "smooth/lattice_sites.h"

namespace regionmesh {

/// The interface near a site, linear: height over the surface at the centroid, and the height's gradient.
struct SiteEstimate {
    double height = 0;
    Vec3 slope;
    double rest = 1;  // share that no scale has decided yet; height and slope are sums with weights 1 - rest
};

/// Cuts space into blocks of about `size` and fits one quadric to each sheet of an interface in a block, from the sites
/// within kReach blocks. A quadric is accepted if it passes through (nearly) every simplex within kBlend blocks: then
/// it is a surface that explains the labels there.
class LatticeLevel {
public:
    static constexpr double kReach = 2.2, kBlend = 1.3;  // radii in blocks

    struct Options {
        double size;             // of blocks; along an axis with wider spacing that spacing
        bool takes_all = false;  // accept every quadric: the finest scale
        std::uint32_t threads = 0;
    };

    LatticeLevel(std::span<const LatticeSite> sites, const LatticeFrame& frame, const Options& options);

    /// Gives accepted quadrics the rest of each site's estimate, blended.
    void refine(std::span<SiteEstimate> estimates);

private:
    struct Sample {
        Vec3 position, normal;
        double count;
        std::uint32_t interface;
        std::uint8_t kind, direction;
    };
    struct Fit {
        HeightQuadric quadric;
        std::uint32_t interface;
        double accepted;  // 0 to 1; below 0: could not be fitted
    };
    struct Range {
        std::uint32_t first, end;
    };
    struct Block {
        std::array<std::int32_t, 3> place;
        Range sites, samples, fits;
    };

    void sort_sites();
    void make_samples(Block& block);
    struct Group {
        Vec3 position, normal;  // sums
        double count;
        std::uint32_t interface;
    };
    void make_fits(Block& block);
    std::vector<Group> groups_of(const Block& block) const;
    template <class Visit>
    void for_blocks_near(const Block& block, int rings, Visit&& visit) const;
    bool is_undecided(const Block& block, std::span<const SiteEstimate> estimates) const;
    void fit_block(const Block& block);
    double acceptance(const Fit& fit, std::span<const std::uint32_t> sites) const;
    void blend_block(const Block& block, std::span<SiteEstimate> estimates) const;
    double distance2(Vec3 d) const;

    std::span<const LatticeSite> sites_;
    LatticeFrame frame_;
    Options options_;
    Vec3 size_;
    double finest_extent_;
    std::array<SimplexEdges, kKindCount> edges_;
    std::vector<std::uint32_t> order_;  // sites by block
    std::vector<Block> blocks_;         // by place, the first axis fastest
    std::vector<Sample> samples_;
    std::vector<Fit> fits_;
};

}  // namespace regionmesh
