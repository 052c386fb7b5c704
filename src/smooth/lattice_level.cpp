#include "smooth/lattice_level.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel_for.h"

namespace regionmesh {
namespace {

/// Sites of one kind of simplex in a cell of a third of a block are one sample.
constexpr int kCellsPerBlock = 3;

/// Normals count as of one sheet above this cosine; two sides of a thin region face away from each other.
constexpr double kSameSheet = 0.2;

/// Groups of sites in a block are one sheet above this cosine.
constexpr double kJoins = 0.7;

/// A quadric may miss a simplex by this share of the spacing along its normal.
constexpr double kTolerance = 0.3;

/// Least extent of a simplex in weights, as a share of the finest spacing.
constexpr double kFinestExtent = 0.1;

/// Weight of a quadric in the corners of its own block, which may lie beyond kBlend.
constexpr double kOwnWeight = 1e-6;

/// The axis along which a normal is longest, and its sign: sites of a block are parted by it.
std::uint8_t direction_of(Vec3 normal) {
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
    return static_cast<std::uint8_t>(2 * axis + (normal[axis] > 0));
}

std::span<const Vec3> span_of(const SimplexEdges& edges) {
    return {edges.edges.data(), static_cast<std::size_t>(edges.count)};
}

}  // namespace

LatticeLevel::LatticeLevel(std::span<const LatticeSite> sites, const LatticeFrame& frame, const Options& options)
    : sites_(sites), frame_(frame), options_(options), finest_extent_(kFinestExtent * frame.finest()) {
    for (int axis = 0; axis < 3; ++axis) size_[axis] = std::max(options.size, frame.spacing[axis]);
    for (int kind = 0; kind < kKindCount; ++kind) edges_[kind] = edges_of(kind, frame.spacing);
    sort_sites();
    for (Block& block : blocks_) {
        make_samples(block);
        make_fits(block);
    }
}

/// Square of a length measured in blocks.
double LatticeLevel::distance2(Vec3 d) const { return length2({d.x / size_.x, d.y / size_.y, d.z / size_.z}); }

void LatticeLevel::sort_sites() {
    struct Entry {
        std::array<std::int32_t, 3> place;  // slow axis first
        std::uint32_t group;
        std::uint32_t site;
    };
    std::vector<Entry> entries(sites_.size());
    for (std::uint32_t s = 0; s < sites_.size(); ++s) {
        Entry& entry = entries[s];
        std::uint32_t cell = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // The small shift keeps centroids on a plane between cells on one side of it, whatever their rounding.
            const double at = (sites_[s].position[axis] - frame_.origin[axis]) / size_[axis] * kCellsPerBlock + 1e-6;
            const auto whole = static_cast<std::int32_t>(std::floor(at));
            entry.place[2 - axis] = whole / kCellsPerBlock;
            cell = cell * kCellsPerBlock + static_cast<std::uint32_t>(whole % kCellsPerBlock);
        }
        entry.group = (cell * kKindCount + sites_[s].kind) * 6 + direction_of(sites_[s].normal);
        entry.site = s;
    }
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
        return std::tie(a.place, a.group, sites_[a.site].interface, a.site) <
               std::tie(b.place, b.group, sites_[b.site].interface, b.site);
    });
    order_.resize(entries.size());
    for (std::uint32_t n = 0; n < entries.size(); ++n) {
        order_[n] = entries[n].site;
        if (n == 0 || entries[n].place != entries[n - 1].place) blocks_.push_back({entries[n].place, {n, n}, {}, {}});
        blocks_.back().sites.end = n + 1;
    }
}

void LatticeLevel::make_samples(Block& block) {
    block.samples.first = static_cast<std::uint32_t>(samples_.size());
    std::array<std::int64_t, 3> last{-1, -1, -1};
    for (std::uint32_t n = block.sites.first; n < block.sites.end; ++n) {
        const LatticeSite& site = sites_[order_[n]];
        std::array<std::int64_t, 3> cell;
        for (int axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<std::int64_t>(
                std::floor((site.position[axis] - frame_.origin[axis]) / size_[axis] * kCellsPerBlock + 1e-6));
        const std::uint8_t direction = direction_of(site.normal);
        if (n == block.sites.first || cell != last || samples_.back().kind != site.kind ||
            samples_.back().direction != direction || samples_.back().interface != site.interface)
            samples_.push_back({{}, {}, 0, site.interface, site.kind, direction});
        last = cell;
        Sample& sample = samples_.back();
        sample.position += site.position;
        sample.normal += site.normal;
        sample.count += 1;
    }
    block.samples.end = static_cast<std::uint32_t>(samples_.size());
    for (std::uint32_t s = block.samples.first; s < block.samples.end; ++s) {
        samples_[s].position = samples_[s].position / samples_[s].count;
        samples_[s].normal = samples_[s].normal / length(samples_[s].normal);
    }
}

/// Sites of a block by interface and direction; a group that faces about the same way as a larger one joins it.
std::vector<LatticeLevel::Group> LatticeLevel::groups_of(const Block& block) const {
    std::vector<std::uint32_t> sorted;
    for (std::uint32_t s = block.samples.first; s < block.samples.end; ++s) sorted.push_back(s);
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::tie(samples_[a].interface, samples_[a].direction, a) <
               std::tie(samples_[b].interface, samples_[b].direction, b);
    });
    std::vector<Group> groups;
    for (std::uint32_t n = 0; n < sorted.size(); ++n) {
        const Sample& sample = samples_[sorted[n]];
        if (n == 0 || sample.interface != groups.back().interface ||
            sample.direction != samples_[sorted[n - 1]].direction)
            groups.push_back({{}, {}, 0, sample.interface});
        groups.back().position += sample.count * sample.position;
        groups.back().normal += sample.count * sample.normal;
        groups.back().count += sample.count;
    }
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return a.interface != b.interface ? a.interface < b.interface : a.count > b.count;
    });
    std::vector<Group> joined;
    for (const Group& group : groups) {
        const auto larger = std::find_if(joined.begin(), joined.end(), [&](const Group& other) {
            return other.interface == group.interface &&
                   dot(other.normal, group.normal) > kJoins * length(other.normal) * length(group.normal);
        });
        if (larger == joined.end()) {
            joined.push_back(group);
            continue;
        }
        larger->position += group.position;
        larger->normal += group.normal;
        larger->count += group.count;
    }
    return joined;
}

void LatticeLevel::make_fits(Block& block) {
    block.fits.first = static_cast<std::uint32_t>(fits_.size());
    for (const Group& group : groups_of(block))
        fits_.push_back(
            {HeightQuadric(group.position / group.count, group.normal / length(group.normal)), group.interface, 0});
    block.fits.end = static_cast<std::uint32_t>(fits_.size());
}

/// In order of place, the block itself included.
template <class Visit>
void LatticeLevel::for_blocks_near(const Block& block, int rings, Visit&& visit) const {
    const auto& [k, j, i] = block.place;
    for (std::int32_t z = k - rings; z <= k + rings; ++z)
        for (std::int32_t y = j - rings; y <= j + rings; ++y) {
            const std::array<std::int32_t, 3> low{z, y, i - rings}, high{z, y, i + rings};
            auto found = std::lower_bound(blocks_.begin(), blocks_.end(), low,
                                          [](const Block& b, const auto& place) { return b.place < place; });
            for (; found != blocks_.end() && found->place <= high; ++found) visit(*found);
        }
}

bool LatticeLevel::is_undecided(const Block& block, std::span<const SiteEstimate> estimates) const {
    for (std::uint32_t n = block.sites.first; n < block.sites.end; ++n)
        if (estimates[order_[n]].rest > 0) return true;
    return false;
}

void LatticeLevel::refine(std::span<SiteEstimate> estimates) {
    const auto count = static_cast<std::uint32_t>(blocks_.size());
    const int rings = static_cast<int>(std::ceil(kBlend));
    std::vector<char> is_open(count), is_wanted(count);
    for (std::uint32_t b = 0; b < count; ++b) is_open[b] = is_undecided(blocks_[b], estimates);
    for (std::uint32_t b = 0; b < count; ++b)
        if (is_open[b])
            for_blocks_near(blocks_[b], rings, [&](const Block& near) { is_wanted[&near - blocks_.data()] = 1; });
    parallel_for(count, options_.threads, [&](std::uint32_t b) {
        if (is_wanted[b]) fit_block(blocks_[b]);
    });
    parallel_for(count, options_.threads, [&](std::uint32_t b) {
        if (is_open[b]) blend_block(blocks_[b], estimates);
    });
}

void LatticeLevel::fit_block(const Block& block) {
    std::vector<std::uint32_t> near_samples, near_sites;
    for_blocks_near(block, static_cast<int>(std::ceil(kReach)), [&](const Block& near) {
        for (std::uint32_t s = near.samples.first; s < near.samples.end; ++s) near_samples.push_back(s);
    });
    if (!options_.takes_all)
        for_blocks_near(block, static_cast<int>(std::ceil(kBlend)), [&](const Block& near) {
            near_sites.insert(near_sites.end(), &order_[near.sites.first],
                              &order_[near.sites.first] + (near.sites.end - near.sites.first));
        });
    const double reach = kReach * options_.size;
    std::vector<HeightSample> chosen;
    for (std::uint32_t f = block.fits.first; f < block.fits.end; ++f) {
        Fit& fit = fits_[f];
        chosen.clear();
        for (std::uint32_t s : near_samples) {
            const Sample& sample = samples_[s];
            if (sample.interface != fit.interface) continue;
            const double share = 1 - distance2(sample.position - fit.quadric.centre) / (kReach * kReach);
            const double along = dot(sample.normal, fit.quadric.normal);
            if (share <= 0 || along <= kSameSheet) continue;
            chosen.push_back({sample.position, share * share * along * sample.count, span_of(edges_[sample.kind])});
        }
        if (!fit.quadric.fit(chosen, reach, finest_extent_))
            fit.accepted = -1;
        else
            fit.accepted = options_.takes_all ? 1 : acceptance(fit, near_sites);
    }
}

/// 1 where the quadric passes through all simplices within kBlend, 0 where it misses one by the tolerance.
double LatticeLevel::acceptance(const Fit& fit, std::span<const std::uint32_t> sites) const {
    const HeightQuadric& quadric = fit.quadric;
    Vec3 along;
    for (int axis = 0; axis < 3; ++axis) along[axis] = quadric.normal[axis] * frame_.spacing[axis];
    const double tolerance = kTolerance * length(along);
    double worst = 0;
    for (std::uint32_t s : sites) {
        const LatticeSite& site = sites_[s];
        if (site.interface != fit.interface || distance2(site.position - quadric.centre) >= kBlend * kBlend ||
            dot(site.normal, quadric.normal) <= kSameSheet)
            continue;
        const Vec3 slope = quadric.gradient(site.position);
        const double height = quadric.height(site.position);
        const ExtentAlong extent = extent_along(span_of(edges_[site.kind]), slope);
        worst = std::max(worst, std::max(height + extent.low, -height - extent.high) / length(slope));
        if (worst >= tolerance) return 0;
    }
    return std::min(1.0, 2 - 2 * worst / tolerance);
}

void LatticeLevel::blend_block(const Block& block, std::span<SiteEstimate> estimates) const {
    std::vector<std::uint32_t> near;
    for_blocks_near(block, static_cast<int>(std::ceil(kBlend)), [&](const Block& other) {
        for (std::uint32_t f = other.fits.first; f < other.fits.end; ++f)
            if (fits_[f].accepted >= 0) near.push_back(f);
    });
    for (std::uint32_t n = block.sites.first; n < block.sites.end; ++n) {
        const LatticeSite& site = sites_[order_[n]];
        SiteEstimate& estimate = estimates[order_[n]];
        if (estimate.rest == 0) continue;
        double all = 0, accepted = 0, height = 0;
        Vec3 slope;
        for (std::uint32_t f : near) {
            const Fit& fit = fits_[f];
            if (fit.interface != site.interface) continue;
            const double share = 1 - distance2(site.position - fit.quadric.centre) / (kBlend * kBlend);
            const double along = dot(site.normal, fit.quadric.normal) - kSameSheet;
            double weight = share > 0 && along > 0 ? share * share * along : 0;
            if (f >= block.fits.first && f < block.fits.end && along > -kSameSheet) weight += kOwnWeight;
            if (weight == 0) continue;
            all += weight;
            weight *= fit.accepted;
            if (weight == 0) continue;
            accepted += weight;
            Vec3 at = site.position;
            const SimplexEdges& edges = edges_[site.kind];
            if (edges.count == 1) {
                // Where the quadric crosses the edge, so that it is linear there and not at the midpoint.
                const double steep = dot(fit.quadric.gradient(at), edges.edges[0]);
                const double step = steep == 0 ? 0 : std::clamp(-fit.quadric.height(at) / steep, -0.5, 0.5);
                at += step * edges.edges[0];
            }
            const Vec3 gradient = fit.quadric.gradient(at);
            height += weight * (fit.quadric.height(at) + dot(gradient, site.position - at));
            slope += weight * gradient;
        }
        if (accepted == 0) continue;
        const double share = estimate.rest / all;
        estimate.height += share * height;
        estimate.slope += share * slope;
        estimate.rest *= 1 - accepted / all;
    }
}

}  // namespace regionmesh
