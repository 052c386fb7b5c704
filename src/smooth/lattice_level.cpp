#include "smooth/lattice_level.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/parallel_for.h"

namespace regionmesh {
namespace {

/// Normals count as of one sheet above this cosine; two sides of a thin region face away from each other.
constexpr float kSameSheet = 0.2f;

/// Groups of sites in a block are one sheet above this cosine.
constexpr float kJoins = 0.7f;

/// A quadric may miss a simplex by this share of the spacing along its normal.
constexpr float kTolerance = 0.3f;

/// Weight of a quadric in the corners of its own block, which may lie beyond kBlend.
constexpr float kOwnWeight = 1e-6f;

/// Extents of simplices depend on the slope of the quadric: fitted again with the slopes found first, for wide
/// terraces. On the finest scale once more gains nothing.
constexpr int kRounds = 2, kFinestRounds = 1;

/// The axis along which a normal is longest, and its sign: sites of a block are parted by it.
std::uint8_t direction_of(Float3 normal) {
    const float sizes[3] = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const float signs[3] = {normal.x, normal.y, normal.z};
    const int axis = sizes[1] > sizes[0] ? (sizes[2] > sizes[1] ? 2 : 1) : (sizes[2] > sizes[0] ? 2 : 0);
    return static_cast<std::uint8_t>(2 * axis + (signs[axis] > 0));
}

}  // namespace

LatticeLevel::LatticeLevel(const LatticeSites& sites, SlidingArray<SiteEstimate>& estimates, const Options& options)
    : sites_(sites), estimates_(estimates), options_(options) {
    const LatticeFrame& frame = sites.frame();
    spacing_ = Float3(frame.spacing / frame.finest());
    const auto size = static_cast<float>(options.size);
    size_ = {std::max(size, spacing_.x), std::max(size, spacing_.y), std::max(size, spacing_.z)};
    per_size_ = {1 / size_.x, 1 / size_.y, 1 / size_.z};
}

/// Square of a length measured in blocks.
float LatticeLevel::distance2(Float3 d) const {
    const Float3 in_blocks{d.x * per_size_.x, d.y * per_size_.y, d.z * per_size_.z};
    return dot(in_blocks, in_blocks);
}

/// The cell, a third of a block, of a coordinate in finest spacings. The small shift keeps centroids on a plane between
/// cells on one side of it, whatever their rounding.
std::int64_t LatticeLevel::place_of(double coordinate, int axis) const {
    return static_cast<std::int64_t>(std::floor(coordinate / size_along(axis) * kCells + 1e-4));
}

void LatticeLevel::add(std::uint32_t site, double coordinate) {
    const std::int64_t layer = layer_of(coordinate);
    while (layer_end() <= layer) layers_.emplace_back();
    layers_[layer - first_layer_].sites.push_back(site);
}

std::int64_t LatticeLevel::cell_of(std::uint32_t site, int axis) const {
    return place_of(sites_[site].centroid.at[axis] * LatticePoint::kStep, axis);
}

void LatticeLevel::seal_before(std::int64_t end) {
    whole_ = std::max(whole_, end);
    while (layer_end() < whole_) layers_.emplace_back();
}

/// Sorts the sites of a layer into rows and blocks.
void LatticeLevel::sort(Layer& layer) {
    const int axis = (options_.sweep_axis + 2) % 3;
    for (std::uint32_t s : layer.sites) {
        const std::size_t n = cell_of(s, axis) / kCells;
        if (layer.rows.size() <= n) layer.rows.resize(n + 1);
        layer.rows[n].sites.push_back(s);
    }
    layer.sites = {};
    parallel_for(static_cast<std::uint32_t>(layer.rows.size()), options_.threads,
                 [&](std::uint32_t n) { fill_row(layer.rows[n]); });
}

void LatticeLevel::fill_row(Row& row) const {
    struct Entry {
        std::uint64_t block_interface, rest;  // rest: direction, cell in the block, kind
        std::uint32_t site;
        bool operator<(const Entry& other) const {
            return std::tie(block_interface, rest, site) < std::tie(other.block_interface, other.rest, other.site);
        }
    };
    const int axes[3] = {options_.sweep_axis, (options_.sweep_axis + 2) % 3, (options_.sweep_axis + 1) % 3};
    std::vector<Entry> entries;
    entries.reserve(row.sites.size());
    for (std::uint32_t s : row.sites) {
        const LatticeSite& site = sites_[s];
        const std::int64_t along = cell_of(s, axes[2]);
        std::uint64_t rest = direction_of(site.normal);
        rest = rest * kCells + static_cast<std::uint64_t>(cell_of(s, axes[0]) % kCells);
        rest = rest * kCells + static_cast<std::uint64_t>(cell_of(s, axes[1]) % kCells);
        rest = rest * kCells + static_cast<std::uint64_t>(along % kCells);
        entries.push_back(
            {static_cast<std::uint64_t>(along / kCells) << 32 | site.interface, rest * kKindCount + site.kind, s});
    }
    std::sort(entries.begin(), entries.end());
    row.sites.clear();
    row.sites.reserve(entries.size());
    std::vector<std::uint64_t> keys;
    keys.reserve(entries.size());
    for (std::uint32_t n = 0; n < entries.size(); ++n) {
        const std::uint64_t run = entries[n].block_interface;
        if (n == 0 || run != entries[n - 1].block_interface)
            row.runs.push_back({static_cast<std::uint32_t>(run), n, 0, 0, static_cast<std::int32_t>(run >> 32)});
        row.sites.push_back(entries[n].site);
        keys.push_back(entries[n].rest);
    }
    row.runs.push_back({0, static_cast<std::uint32_t>(entries.size()), 0, 0, std::numeric_limits<std::int32_t>::max()});
    make_samples(row, keys);
    make_fits(row);
    row.runs.shrink_to_fit();
    row.samples.pad();
    row.fits.shrink_to_fit();
}

void LatticeLevel::Samples::push_back(const Sample& sample) {
    const float along[3] = {sample.normal.x, sample.normal.y, sample.normal.z};
    for (int axis = 0; axis < 3; ++axis) {
        at[axis].push_back(sample.position.at[axis]);
        normal[axis].push_back(along[axis]);
    }
    count.push_back(sample.count);
    kind.push_back(sample.kind);
}

void LatticeLevel::Samples::pad() {
    for (int n = 0; n < 3; ++n) push_back({{}, {}, 0, 1});
    for (int axis = 0; axis < 3; ++axis) {
        at[axis].shrink_to_fit();
        normal[axis].shrink_to_fit();
    }
    count.shrink_to_fit();
    kind.shrink_to_fit();
}

/// One sample for the sites of a run that have the same key.
void LatticeLevel::make_samples(Row& row, const std::vector<std::uint64_t>& keys) const {
    for (std::size_t r = 0; r + 1 < row.runs.size(); ++r) {
        row.runs[r].sample = row.samples.size();
        const std::uint32_t end = row.runs[r + 1].site;
        for (std::uint32_t first = row.runs[r].site, next; first < end; first = next) {
            const LatticeSite& site = sites_[row.sites[first]];
            Float3 offset, normal;
            for (next = first; next < end && keys[next] == keys[first]; ++next) {
                const LatticeSite& other = sites_[row.sites[next]];
                offset += other.centroid - site.centroid;
                normal += other.normal;
            }
            const auto count = static_cast<float>(next - first);
            row.samples.push_back({site.centroid + (1 / count) * offset, (1 / length(normal)) * normal, count,
                                   static_cast<std::uint8_t>(site.kind)});
        }
    }
    row.runs.back().sample = row.samples.size();
}

/// Samples of a run by direction; a group that faces about the same way as a larger one joins it. Positions are sums of
/// offsets from the first sample.
std::vector<LatticeLevel::Group> LatticeLevel::groups_of(const Row& row, const Run& run) const {
    const std::uint32_t end = (&run + 1)->sample;
    const Samples& samples = row.samples;
    std::vector<Group> groups;
    for (std::uint32_t n = run.sample; n < end; ++n) {
        const Float3 normal = samples.normal_of(n);
        const std::uint8_t direction = direction_of(normal);
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.direction == direction; });
        if (group == groups.end()) group = groups.insert(group, {{}, {}, 0, direction});
        group->position += samples.count[n] * (samples.position(n) - samples.position(run.sample));
        group->normal += samples.count[n] * normal;
        group->count += samples.count[n];
    }
    std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return std::tuple(-a.count, a.direction) < std::tuple(-b.count, b.direction);
    });
    std::vector<Group> joined;
    for (const Group& group : groups) {
        const auto larger = std::find_if(joined.begin(), joined.end(), [&](const Group& other) {
            return dot(other.normal, group.normal) > kJoins * length(other.normal) * length(group.normal);
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

void LatticeLevel::make_fits(Row& row) const {
    for (std::size_t r = 0; r + 1 < row.runs.size(); ++r) {
        row.runs[r].fit = static_cast<std::uint32_t>(row.fits.size());
        for (const Group& group : groups_of(row, row.runs[r])) {
            const LatticePoint centre = row.samples.position(row.runs[r].sample) + (1 / group.count) * group.position;
            row.fits.push_back({HeightQuadric(centre, (1 / length(group.normal)) * group.normal)});
        }
    }
    row.runs.back().fit = static_cast<std::uint32_t>(row.fits.size());
}

/// Calls visit(layer, row number, row, run) for the runs of the same interface within kRings blocks, the run itself
/// included.
template <class Visit>
void LatticeLevel::for_runs_near(const RunPlace& at, Visit&& visit) {
    const std::int32_t place = row(at).runs[at.run].place;
    const std::uint32_t interface = row(at).runs[at.run].interface;
    const std::int64_t end_layer = std::min(layer_end(), at.layer + kRings + 1);
    for (std::int64_t l = std::max(first_layer_, at.layer - kRings); l < end_layer; ++l) {
        std::vector<Row>& rows = layers_[l - first_layer_].rows;
        const auto row_end = std::min(static_cast<std::int32_t>(rows.size()), at.row + kRings + 1);
        for (std::int32_t r = std::max(0, at.row - kRings); r < row_end; ++r) {
            std::vector<Run>& runs = rows[r].runs;
            auto run = std::lower_bound(runs.begin(), runs.end(), place - kRings,
                                        [](const Run& other, std::int32_t p) { return other.place < p; });
            for (; run != runs.end() && run->place <= place + kRings; ++run)
                if (run->interface == interface) visit(l, r, rows[r], static_cast<std::uint32_t>(run - runs.begin()));
        }
    }
}

void LatticeLevel::refine(bool is_last) {
    const std::int64_t end = is_last ? whole_ : whole_ - 2 * kRings;
    const auto is_decided = [&](std::int64_t layer) {
        const double last = (static_cast<double>(layer) + 0.99999) * size_along(options_.sweep_axis);
        return is_last || !options_.before || options_.before->layer_of(last) < options_.before->refined();
    };
    for (; refined_ < end && is_decided(refined_); ++refined_) {
        // Sorted only now, since samples and fits take more room than sites.
        for (; sorted_ < std::min(whole_, refined_ + 2 * kRings + 1); ++sorted_) sort(layers_[sorted_ - first_layer_]);
        refine_layer(refined_);
        // Layers that come read fits and samples of the last few.
        while (first_layer_ + 2 * kRings <= refined_) {
            layers_.pop_front();
            ++first_layer_;
        }
    }
}

bool LatticeLevel::is_open(const Row& row, std::uint32_t run) const {
    for (std::uint32_t n = row.runs[run].site; n < row.runs[run + 1].site; ++n)
        if (estimates_[row.sites[n]].rest > 0) return true;
    return false;
}

/// Fits are made when a run that needs them is refined: where a coarser level has decided there are none.
void LatticeLevel::refine_layer(std::int64_t layer) {
    std::vector<RunPlace> open, wanted;
    std::vector<Row>& rows = layers_[layer - first_layer_].rows;
    for (const Row& row : rows)
        for (std::uint32_t s : row.sites)
            if (s >= estimates_.end()) estimates_.grow(s + 1);
    for (std::int32_t r = 0; r < static_cast<std::int32_t>(rows.size()); ++r)
        for (std::uint32_t n = 0; n + 1 < rows[r].runs.size(); ++n)
            if (is_open(rows[r], n)) open.push_back({layer, r, n});
    for (const RunPlace& at : open)
        for_runs_near(at, [&](std::int64_t l, std::int32_t r, Row& near, std::uint32_t run) {
            if (!std::exchange(near.runs[run].is_fitted, true)) wanted.push_back({l, r, run});
        });
    parallel_for(static_cast<std::uint32_t>(wanted.size()), options_.threads,
                 [&](std::uint32_t n) { fit_run(wanted[n]); });
    parallel_for(static_cast<std::uint32_t>(open.size()), options_.threads,
                 [&](std::uint32_t n) { blend_run(open[n]); });
}

void LatticeLevel::fit_run(const RunPlace& at) {
    thread_local HeightSamples chosen;
    Row& own = row(at);
    for (std::uint32_t f = own.runs[at.run].fit; f < own.runs[at.run + 1].fit; ++f) {
        Fit& fit = own.fits[f];
        choose(at, fit.quadric, chosen);
        if (!fit.quadric.fit(chosen, spacing_, kReach * static_cast<float>(options_.size),
                             options_.takes_all ? kFinestRounds : kRounds))
            fit.accepted = -1;
        else
            fit.accepted = options_.takes_all ? 1 : acceptance(at, fit.quadric);
    }
}

/// The samples of the sheet within kReach, with a weight that falls with distance. Of four samples side by side either
/// all are taken, some perhaps with weight 0, or none.
void LatticeLevel::choose(const RunPlace& at, const HeightQuadric& quadric, HeightSamples& chosen) {
    constexpr auto kStep = static_cast<float>(LatticePoint::kStep);
    constexpr Lane4 kLane{0, 1, 2, 3};
    const Lanes3<Float4> normal = all_four(quadric.normal), u = all_four(quadric.u), v = all_four(quadric.v);
    const Float3 scale = (1 / kReach) * per_size_;
    chosen.count = 0;
    for_runs_near(at, [&](std::int64_t, std::int32_t, const Row& near, std::uint32_t run) {
        const Samples& samples = near.samples;
        const std::uint32_t first = near.runs[run].sample, end = near.runs[run + 1].sample;
        if (chosen.fours.size() < chosen.count + (end - first) / 4 + 1)
            chosen.fours.resize(2 * (chosen.count + (end - first) / 4 + 1));
        const auto offset = [&](int axis, std::uint32_t s) {
            const Lane4 steps = reinterpret_cast<Lane4>(load<Unsigned4>(&samples.at[axis][s]) - quadric.centre.at[axis]);
            return kStep * __builtin_convertvector(steps, Float4);
        };
        for (std::uint32_t s = first; s < end; s += 4) {
            const Lanes3<Float4> d{offset(0, s), offset(1, s), offset(2, s)};
            const Lanes3<Float4> scaled{scale.x * d.x, scale.y * d.y, scale.z * d.z};
            const Lanes3<Float4> facing{load<Float4>(&samples.normal[0][s]), load<Float4>(&samples.normal[1][s]),
                                        load<Float4>(&samples.normal[2][s])};
            const Float4 share = 1 - dot(scaled, scaled), along = dot(facing, normal);
            const Mask4 counts = share > 0 && along > kSameSheet && kLane < static_cast<std::int32_t>(end - s);
            if (bits_of(counts) == 0) continue;
            const Float4 weight = share * share * along * load<Float4>(&samples.count[s]);
            chosen.fours[chosen.count++] = {dot(d, u), dot(d, v), dot(d, normal), counts ? weight : Float4{},
                                            load<std::array<std::uint8_t, 4>>(&samples.kind[s])};
        }
    });
}

/// 1 where the quadric passes through all simplices within kBlend, 0 where it misses one by the tolerance.
float LatticeLevel::acceptance(const RunPlace& at, const HeightQuadric& quadric) {
    const Float3& normal = quadric.normal;
    const float tolerance =
        kTolerance * length(Float3{normal.x * spacing_.x, normal.y * spacing_.y, normal.z * spacing_.z});
    float worst = 0;
    for_runs_near(at, [&](std::int64_t, std::int32_t, const Row& near, std::uint32_t run) {
        for (std::uint32_t n = near.runs[run].site; worst < tolerance && n < near.runs[run + 1].site; ++n) {
            const LatticeSite& site = sites_[near.sites[n]];
            const Float3 d = site.centroid - quadric.centre;
            if (distance2(d) >= kBlend * kBlend || dot(site.normal, normal) <= kSameSheet) continue;
            const Float3 place = quadric.along(d), slope = quadric.gradient(place);
            const float height = quadric.height(place);
            const ExtentAlong extent = extent_along(site.kind, slope, spacing_);
            worst = std::max(worst, std::max(height + extent.low, -height - extent.high) / length(slope));
        }
    });
    return worst >= tolerance ? 0 : std::min(1.0f, 2 - 2 * worst / tolerance);
}

/// Fits whose centre lies within kBlend of some site of the run.
std::vector<const LatticeLevel::Fit*>& LatticeLevel::fits_near(const RunPlace& at) {
    thread_local std::vector<const Fit*> fits;
    fits.clear();
    const Row& own = row(at);
    const LatticePoint first = sites_[own.sites[own.runs[at.run].site]].centroid;
    Float3 low, high;
    for (std::uint32_t n = own.runs[at.run].site; n < own.runs[at.run + 1].site; ++n) {
        const Float3 d = sites_[own.sites[n]].centroid - first;
        low = {std::min(low.x, d.x), std::min(low.y, d.y), std::min(low.z, d.z)};
        high = {std::max(high.x, d.x), std::max(high.y, d.y), std::max(high.z, d.z)};
    }
    const auto beyond = [](float at_, float low_, float high_) { return std::max({low_ - at_, at_ - high_, 0.0f}); };
    for_runs_near(at, [&](std::int64_t, std::int32_t, const Row& near, std::uint32_t run) {
        for (std::uint32_t f = near.runs[run].fit; f < near.runs[run + 1].fit; ++f) {
            const Fit& fit = near.fits[f];
            const Float3 d = fit.quadric.centre - first;
            const Float3 gap{beyond(d.x, low.x, high.x), beyond(d.y, low.y, high.y), beyond(d.z, low.z, high.z)};
            const bool is_own = &near == &own && run == at.run;
            if (fit.accepted >= 0 && (is_own || distance2(gap) < kBlend * kBlend)) fits.push_back(&fit);
        }
    });
    return fits;
}

void LatticeLevel::blend_run(const RunPlace& at) {
    const std::vector<const Fit*>& near_fits = fits_near(at);
    const Row& own = row(at);
    const Fit* const own_first = own.fits.data() + own.runs[at.run].fit;
    const Fit* const own_end = own.fits.data() + own.runs[at.run + 1].fit;
    for (std::uint32_t n = own.runs[at.run].site; n < own.runs[at.run + 1].site; ++n) {
        const LatticeSite& site = sites_[own.sites[n]];
        SiteEstimate& estimate = estimates_[own.sites[n]];
        if (estimate.rest == 0) continue;
        float all = 0, accepted = 0, height = 0;
        Float3 slope;
        for (const Fit* fit : near_fits) {
            const HeightQuadric& quadric = fit->quadric;
            const Float3 d = site.centroid - quadric.centre;
            const float share = 1 - distance2(d) * (1 / (kBlend * kBlend));
            const float along = dot(site.normal, quadric.normal) - kSameSheet;
            float weight = share > 0 && along > 0 ? share * share * along : 0;
            if (fit >= own_first && fit < own_end && along > -kSameSheet) weight += kOwnWeight;
            if (weight == 0) continue;
            all += weight;
            weight *= fit->accepted;
            if (weight == 0) continue;
            accepted += weight;
            const LinearHeight linear = linear_height(quadric, d, site.kind);
            height += weight * linear.height;
            slope += weight * linear.slope;
        }
        if (accepted == 0) continue;
        const float portion = estimate.rest / all;
        estimate.height += portion * height;
        estimate.slope += portion * slope;
        estimate.rest = accepted == all ? 0 : estimate.rest * (1 - accepted / all);
    }
}

/// The quadric near a centroid, linear; for an edge where the quadric crosses it, so that it is linear there and not
/// at the midpoint.
LatticeLevel::LinearHeight LatticeLevel::linear_height(const HeightQuadric& quadric, Float3 d, int kind) const {
    const Float3 centroid = quadric.along(d);
    if (kKinds[kind].node_count != 2) return {quadric.height(centroid), quadric.gradient(centroid)};
    const int steps = kKinds[kind].steps[1];
    const Float3 edge{steps & 1 ? spacing_.x : 0, steps & 2 ? spacing_.y : 0, steps & 4 ? spacing_.z : 0};
    const float steep = dot(quadric.gradient(centroid), edge);
    const float step = steep == 0 ? 0 : std::clamp(-quadric.height(centroid) / steep, -0.5f, 0.5f);
    const Float3 crossing = quadric.along(d + step * edge), slope = quadric.gradient(crossing);
    return {quadric.height(crossing) - dot(slope, step * edge), slope};
}

std::size_t LatticeLevel::bytes() const {
    std::size_t sum = 0;
    for (const Layer& layer : layers_) {
        sum += layer.sites.capacity() * sizeof(std::uint32_t);
        for (const Row& row : layer.rows)
            sum += row.sites.capacity() * sizeof(std::uint32_t) + row.runs.capacity() * sizeof(Run) +
                   row.samples.bytes() + row.fits.capacity() * sizeof(Fit);
    }
    return sum;
}

}  // namespace regionmesh
