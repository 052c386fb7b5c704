#include "smooth/lattice/lattice_fits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace regionmesh {
namespace {

/// A quadric may miss a simplex by this share of the spacing along its normal.
constexpr float kTolerance = 0.3f;

/// A trial fit comes first, in one round, to every fourth four of samples. If it misses too many simplices by this
/// share of the spacing, of every fourth four of sites, the full fit is not made: most fits to noisy labels end here.
/// Simplices of short extent count less in it, since with few samples one of them would decide the fit.
constexpr float kTrialTolerance = 0.6f;
constexpr std::uint32_t kTrialStride = 4;
constexpr float kTrialExtent = 0.3f;

/// Least extent of a simplex in the weights of other fits, in finest spacings.
constexpr float kLeastExtent = 0.1f;

/// Sites may be missed (LatticeSheet::Agreement) only where the quadric turns by less than this within kBlend
/// (radians): what misses sites beside a small ball is not its surface. With any turn, balls of radius 10 get 1.7
/// instead of 1.5 degrees.
constexpr float kMostTurn = 0.8f;

/// Where sections are far apart, the crossings of a quadric may lie on one side of the middles of the edges by this
/// share of half of the edges, on the whole. True surfaces cross edges anywhere; but the rim of a cap, whose edges are
/// short and weigh most, draws a quadric onto the last section of a region, from which it still meets every long edge.
/// A torus 8 samples thick and parallel to sections 3 samples apart, a ball of radius 6 and sections 5 apart: rms 1.32
/// and 1.01 without, 0.57 and 0.59 with it, and with 0.35 and 0.8 nearly the same; planes of any slope do not change.
constexpr float kMostOneSided = 0.6f;

/// Blocks that begin beyond this share of a radius are not looked at: what lies there has less than a twelfth of the
/// weight of the centre.
constexpr float kNearShare = 0.85f;

/// Weight of a quadric in the corners of its own block, which may lie beyond kBlend.
constexpr float kOwnWeight = 1e-6f;

/// Extents of simplices depend on the slope of the quadric: fitted again with the slopes found first, for wide
/// terraces. On the finest scale once more gains nothing.
constexpr int kRounds = 2, kFinestRounds = 1;

using Points4 = std::array<Unsigned4, 3>;
Lanes3<Float4> offset(const LatticeSteps& steps, const LatticePoint& from, const Points4& at) {
    const auto along = [&](int axis) {
        return steps.size(axis) * __builtin_convertvector(reinterpret_cast<Lane4>(at[axis] - from.at[axis]), Float4);
    };
    return {along(0), along(1), along(2)};
}

/// 1 for each of the first `count` lanes, at least one, 0 for the others.
Float4 in_use(std::uint32_t count) {
    const auto lane = [&](std::uint32_t n) { return n < count ? 1.0f : 0.0f; };
    return Float4{1, lane(1), lane(2), lane(3)};
}

/// 1 less the square of a length measured in radii.
struct Share {
    Float3 per_radius;
    Float4 operator()(const Lanes3<Float4>& d) const {
        const Lanes3<Float4> scaled{per_radius.x * d.x, per_radius.y * d.y, per_radius.z * d.z};
        return 1 - dot(scaled, scaled);
    }
};

}  // namespace

/// Four sites; the last one repeated where there are fewer.
struct LatticeFits::Sites4 {
    Points4 at;
    Lanes3<Float4> normal;
    Kinds4 kind;
};

/// By how much a quadric passes four simplices by (below 0 where it passes through), its heights at their centroids,
/// and half of their extents across it.
struct LatticeFits::Passage4 {
    Float4 missed, offset, half;
};

/// Sums over fits, or means, of what they say at four sites.
struct LatticeFits::Blend4 {
    Float4 all{}, accepted{};  // weights
    Float4 height{};
    Lanes3<Float4> slope;
    std::array<Float4, 6> curvature{};
};

/// Gaps between a box, such as the centre of a fit, and the blocks near its own: blocks beyond a radius are left out.
class LatticeFits::Gaps {
public:
    Gaps(const LatticeBlocks& blocks, const LatticePoint& own, const LatticePoint& low, const LatticePoint& high) {
        constexpr double kSlack = 1e-3;
        for (int axis = 0; axis < 3; ++axis) {
            const double size = blocks.size_along(axis);
            const std::int64_t block = blocks.block_of(own, axis);
            const auto place = [&](const LatticePoint& p) {
                return blocks.steps.coordinate(p, axis) / size - static_cast<double>(block);
            };
            const double begin = place(low), end = place(high);
            for (int k = -NearRuns::kRings; k <= NearRuns::kRings; ++k) {
                const double gap = std::max({k - end, begin - k - 1, kSlack}) - kSlack;
                square_[axis][k + NearRuns::kRings] = static_cast<float>(gap * gap);
            }
        }
    }
    bool is_within(float radius, const NearRun& near) const {
        float sum = 0;
        for (int axis = 0; axis < 3; ++axis) sum += square_[axis][near.offset[axis] + NearRuns::kRings];
        return sum < radius * radius;
    }

private:
    float square_[3][2 * NearRuns::kRings + 1];
};

/// Where the blocks near that of `own` have their corners, from the centre of a fit, in finest spacings.
class LatticeFits::Corners {
public:
    Corners(const LatticeBlocks& blocks, const LatticePoint& own, const LatticePoint& centre) {
        if (blocks.parts_sites()) return;  // there are no samples
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t first = blocks.block_of(own, axis) - NearRuns::kRings;
            for (int k = 0; k < 2 * NearRuns::kRings + 1; ++k) {
                const auto steps = static_cast<std::int32_t>(blocks.corner_of(first + k, axis) - centre.at[axis]);
                from_centre_[axis][k] = blocks.steps.size(axis) * static_cast<float>(steps);
            }
        }
    }
    Float3 of(const NearRun& near) const {
        const auto along = [&](int axis) { return from_centre_[axis][near.offset[axis] + NearRuns::kRings]; };
        return {along(0), along(1), along(2)};
    }

private:
    float from_centre_[3][2 * NearRuns::kRings + 1];
};

LatticeFits::LatticeFits(const LatticeSites& sites, const LatticeBlocks& blocks, const Options& options)
    : sites_(sites),
      blocks_(blocks),
      options_(options),
      steps_(blocks.spacing),
      is_anisotropic_(sites.frame().is_anisotropic()),
      agreement_(LatticeSheet::agreement_of(options.cells, is_anisotropic_)) {}

LatticeFits::Sites4 LatticeFits::gather(const std::uint32_t* numbers, std::uint32_t count) const {
    const auto site = [&](std::uint32_t lane) -> const LatticeSite& {
        return sites_[numbers[std::min(lane, count - 1)]];
    };
    const LatticeSite &a = site(0), &b = site(1), &c = site(2), &d = site(3);
    static_assert(offsetof(LatticeSite, code) == 12 && offsetof(LatticeSite, normal) == 16);
    const auto at = transposed(load<Unsigned4>(&a), load<Unsigned4>(&b), load<Unsigned4>(&c), load<Unsigned4>(&d));
    const auto normal =
        transposed(load<Float4>(&a.code), load<Float4>(&b.code), load<Float4>(&c.code), load<Float4>(&d.code));
    return {{at[0], at[1], at[2]}, {normal[1], normal[2], normal[3]}, {a.kind(), b.kind(), c.kind(), d.kind()}};
}

void LatticeFits::find_near(const LatticeRow& row, std::uint32_t run, std::span<const NearRun> near,
                            std::vector<FitPlace>& found) const {
    const LatticePoint& first = sites_[row.sites[row.runs[run].site]].centroid;
    const LatticePoint corner = blocks_.corner_of_block(first);
    const Float3 low = blocks_.from_units(row.runs[run].low), high = blocks_.from_units(row.runs[run].high);
    const LatticeSteps& steps = blocks_.steps;
    const Gaps gaps(blocks_, first, steps.moved(corner, low), steps.moved(corner, high));
    constexpr float kRadius = kNearShare * kBlend;
    const auto beyond = [](float at, float low_, float high_) { return std::max({low_ - at, at - high_, 0.0f}); };
    for (const NearRun& other : near) {
        if (!gaps.is_within(kRadius, other)) continue;
        const bool is_own = other.row == &row && other.run == run;
        for (std::uint32_t f = (*other).fit; f < other.next().fit; ++f) {
            const Float3 d = steps.between(corner, other.row->fits[f].quadric.centre);
            const Float3 gap{beyond(d.x, low.x, high.x), beyond(d.y, low.y, high.y), beyond(d.z, low.z, high.z)};
            if (is_own || blocks_.distance2(gap) < kRadius * kRadius) found.push_back({other.row, other.run, f});
        }
    }
}

void LatticeFits::make(LatticeRow& row, std::uint32_t run, std::span<const NearRun> near) const {
    const LatticePoint& own = sites_[row.sites[row.runs[run].site]].centroid;
    for (std::uint32_t f = row.runs[run].fit; f < row.runs[run + 1].fit; ++f) {
        auto& [quadric, accepted] = row.fits[f];
        const TangentFrame frame(quadric.normal);
        const Gaps gaps(blocks_, own, quadric.centre, quadric.centre);
        const Corners corners(blocks_, own, quadric.centre);
        const float reach = kReach * static_cast<float>(options_.size);
        HeightQuadric trial = quadric;
        bool is_fitted = false;
        if (!options_.takes_all) {
            const HeightSamples& few = choose(quadric, false, frame, gaps, corners, near, kTrialStride);
            is_fitted = trial.fit(few, frame, blocks_.spacing, reach, kFinestRounds, kTrialExtent);
            accepted = is_fitted ? acceptance(trial, gaps, near, true) : 1;
            if (accepted == 0) continue;
        }
        const HeightSamples& chosen = choose(trial, is_fitted, frame, gaps, corners, near, 1);
        const int rounds = options_.takes_all ? kFinestRounds : kRounds;
        if (!quadric.fit(chosen, frame, blocks_.spacing, reach, rounds, kLeastExtent))
            accepted = -1;
        else
            accepted = options_.takes_all ? 1 : acceptance(quadric, gaps, near, false);
    }
}

/// The samples of the sheet of a quadric, which may not be fitted yet, within kReach, with a weight that falls with
/// distance. Of four samples side by side either all are taken, some perhaps with weight 0, or none; of the fours of a
/// run every `stride`th. Valid until the next call on the same thread.
const HeightSamples& LatticeFits::choose(const HeightQuadric& quadric, bool is_fitted, const TangentFrame& frame,
                                         const Gaps& gaps, const Corners& corners, std::span<const NearRun> near,
                                         std::uint32_t stride) const {
    thread_local HeightSamples chosen;
    const Lanes3<Float4> normal = all_four(frame.normal), u = all_four(frame.u), v = all_four(frame.v);
    const Share share_of{(1 / kReach) * blocks_.per_size};
    const LatticeSheet sheet(quadric, blocks_.spacing, agreement_);
    std::uint32_t count = 0, most = 0;
    for (const NearRun& other : near)
        most += other.next().samples - (*other).samples + (other.next().site - (*other).site + 3) / 4;
    if (chosen.fours.size() < most) chosen.fours.resize(2 * most);
    HeightSamples::Four* const fours = chosen.fours.data();
    const auto consider = [&](const Lanes3<Float4>& d, const Lanes3<Float4>& facing, Float4 sites, const Kinds4& kind) {
        const HeightQuadric::At at = quadric.at(d);
        const Float4 share = share_of(d), along = dot(facing, normal), on = sheet.share(d, facing, at.height);
        Mask4 counts = share > 0 && along > LatticeSheet::kFacing && on > 0;
        if (is_fitted) counts = counts && sheet.agrees(at.gradient, facing);
        if (bits_of(counts) == 0) return;
        const Float4 weight = share * share * along * on * sites;
        fours[count++] = {dot(d, u), dot(d, v), dot(d, normal), counts ? weight : Float4{}, kind};
    };
    for (const NearRun& other : near) {
        if (!gaps.is_within(kNearShare * kReach, other)) continue;
        const LatticeRow& row = *other.row;
        if (blocks_.parts_sites()) {
            const std::uint32_t end = other.next().site;
            for (std::uint32_t n = (*other).site; n < end; n += 4 * stride) {
                const Sites4 sites = gather(&row.sites[n], end - n);
                consider(offset(blocks_.steps, quadric.centre, sites.at), sites.normal, in_use(end - n), sites.kind);
            }
            continue;
        }
        const LatticeSamples* const end = row.samples.data() + other.next().samples;
        const Float3 corner = corners.of(other), &unit = blocks_.unit;
        for (const LatticeSamples* s = row.samples.data() + (*other).samples; s < end; s += stride) {
            const Lanes3<Float4> p = s->positions(), m = s->normals();
            constexpr float kUnit = LatticeSamples::kNormalUnit;
            consider({corner.x + unit.x * p.x, corner.y + unit.y * p.y, corner.z + unit.z * p.z},
                     {kUnit * m.x, kUnit * m.y, kUnit * m.z}, s->counts(), s->kind);
        }
    }
    chosen.count = count;
    return chosen;
}

/// 1 where the quadric passes through the simplices of its sheet within kBlend, 0 where it misses too many by the
/// tolerance, passes through long ones on one side, or has the normals of too few sites. A trial is judged by every
/// fourth four of sites, and by normals only where sections are far apart.
float LatticeFits::acceptance(const HeightQuadric& quadric, const Gaps& gaps, std::span<const NearRun> near,
                              bool is_trial) const {
    const Float3 &normal = quadric.normal, &spacing = blocks_.spacing;
    const float tolerance = (is_trial ? kTrialTolerance : kTolerance) *
                            length(Float3{normal.x * spacing.x, normal.y * spacing.y, normal.z * spacing.z});
    const float turn = kBlend * static_cast<float>(options_.size) * quadric.curvedness();
    const float most_missed = turn < kMostTurn ? agreement_.missed : 0;
    const Share share{(1 / kBlend) * blocks_.per_size};
    const LatticeSheet sheet(quadric, spacing, agreement_);
    const auto total = [](Float4 lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); };
    Float4 worst{}, offsets{}, halves{};
    Float4 facing_sites{}, agreeing_sites{}, missed_sites{};
    // Every fourth four first: where a quadric misses one simplex it misses others beside it.
    for (std::uint32_t start = 0; start < (is_trial ? 4 : 16); start += 4) {
        for (const NearRun& other : near) {
            if (!gaps.is_within(kBlend, other)) continue;
            const std::uint32_t end = other.next().site;
            for (std::uint32_t n = (*other).site + start; n < end; n += 16) {
                const Sites4 sites = gather(&other.row->sites[n], end - n);
                const Lanes3<Float4> d = offset(blocks_.steps, quadric.centre, sites.at);
                const HeightQuadric::At at = quadric.at(d);
                const Mask4 facing = share(d) > 0 && dot(sites.normal, all_four(normal)) > LatticeSheet::kFacing &&
                                     sheet.share(d, sites.normal, at.height) > 0;
                if (bits_of(facing) == 0) continue;
                const Mask4 counts = facing && sheet.agrees(at.gradient, sites.normal);
                const Float4 once = in_use(end - n);
                facing_sites += facing ? once : Float4{};
                agreeing_sites += counts ? once : Float4{};
                const Passage4 passes = passage(at, sites.kind);
                const Mask4 misses = counts && passes.missed >= tolerance;
                if (most_missed == 0 && bits_of(misses) != 0) return 0;
                missed_sites += misses ? once : Float4{};
                worst = greatest(worst, counts && passes.missed < tolerance ? passes.missed : Float4{});
                if (!is_anisotropic_) continue;
                offsets += counts ? once * passes.offset : Float4{};
                halves += counts ? once * passes.half : Float4{};
            }
        }
        if (total(missed_sites) > most_missed * total(agreeing_sites)) return 0;
    }
    const bool needs_normals = !is_trial || is_anisotropic_;
    if (needs_normals && total(agreeing_sites) < agreement_.share * total(facing_sites)) return 0;
    const float most = std::max({worst[0], worst[1], worst[2], worst[3]});
    const float accepted = std::min(1.0f, 2 - 2 * most / tolerance);
    const float half = total(halves);
    if (!(half > 0)) return accepted;
    return std::clamp(2 - 2 * std::abs(total(offsets)) / (kMostOneSided * half), 0.0f, accepted);
}

/// Do sites that face the same way lie on the surface that the quadric stands for? It passes through their simplices,
/// or has their normals.
Mask4 LatticeFits::belong(const LatticeSheet& sheet, const HeightQuadric::At& at, const Lanes3<Float4>& normal,
                          const Kinds4& kind) const {
    const Mask4 agrees = sheet.agrees(at.gradient, normal);
    if (bits_of(agrees) == 15) return agrees;
    const Mask4 passes = passage(at, kind).missed <= 0;
    return agrees || passes;
}

/// How a quadric passes through simplices, or by them.
LatticeFits::Passage4 LatticeFits::passage(const HeightQuadric::At& at, const Kinds4& kind) const {
    const Float4 height = at.height;
    const Lanes3<Float4>& slope = at.gradient;
    const Extent4 extent = extent_of(kind, [&](int n) { return dot(slope, steps_.to_node(kind, n)); });
    const auto share = [&](int lane) { return 1 / static_cast<float>(kKinds[kind[lane]].node_count); };
    const Float4 middle = extent.sum * Float4{share(0), share(1), share(2), share(3)};
    const Float4 steepness = square_root(dot(slope, slope));
    return {greatest(height + extent.low - middle, middle - extent.high - height) / steepness, height / steepness,
            0.5f * (extent.high - extent.low) / steepness};
}

void LatticeFits::blend(const LatticeRow& row, std::uint32_t run, std::span<const FitPlace> fits,
                        SlidingPages<SiteEstimate>& estimates) const {
    const auto is_accepted = [](const FitPlace& place) { return place.row->fits[place.fit].accepted > 0; };
    if (std::none_of(fits.begin(), fits.end(), is_accepted)) return;
    const std::uint32_t end = row.runs[run + 1].site;
    for (std::uint32_t n = row.runs[run].site; n < end;) {
        std::uint32_t numbers[4], count = 0;
        for (; n < end && count < 4; ++n)
            if (estimates[row.sites[n]].rest > 0) numbers[count++] = row.sites[n];
        if (count == 0) return;
        const Blend4 mean = blended(gather(numbers, count), row, run, fits);
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            if (mean.accepted[lane] == 0) continue;
            SiteEstimate& estimate = estimates[numbers[lane]];
            const float share = mean.accepted[lane] / mean.all[lane], portion = estimate.rest * share;
            estimate.height += portion * mean.height[lane];
            estimate.slope += portion * Float3{mean.slope.x[lane], mean.slope.y[lane], mean.slope.z[lane]};
            estimate.rest = mean.accepted[lane] == mean.all[lane] ? 0 : estimate.rest * (1 - share);
        }
    }
}

/// The weighted mean of the accepted fits at each site, linear near it.
LatticeFits::Blend4 LatticeFits::blended(const Sites4& sites, const LatticeRow& row, std::uint32_t run,
                                         std::span<const FitPlace> fits) const {
    const Share share_of{(1 / kBlend) * blocks_.per_size};
    Blend4 sums;
    for (const FitPlace& place : fits) {
        const auto& [quadric, accepted] = place.row->fits[place.fit];
        if (accepted < 0) continue;
        const Lanes3<Float4> d = offset(blocks_.steps, quadric.centre, sites.at);
        const HeightQuadric::At at = quadric.at(d);
        const LatticeSheet sheet(quadric, blocks_.spacing, agreement_);
        const Float4 share = share_of(d), along = dot(sites.normal, all_four(quadric.normal)) - LatticeSheet::kFacing,
                     on = sheet.share(d, sites.normal, at.height);
        Float4 weight = share > 0 && along > 0 && on > 0 ? share * share * along * on : Float4{};
        if (place.row == &row && place.run == run)  // the finest scale decides all that is left
            weight +=
                along > -LatticeSheet::kFacing && (on > 0 || options_.takes_all) ? all_four(kOwnWeight) : Float4{};
        if (bits_of(weight > 0) == 0) continue;
        if (!options_.takes_all) weight = belong(sheet, at, sites.normal, sites.kind) ? weight : Float4{};
        sums.all += weight;
        if (accepted == 0) continue;
        weight *= accepted;
        sums.accepted += weight;
        sums.height += weight * at.height;
        sums.slope = {sums.slope.x + weight * at.gradient.x, sums.slope.y + weight * at.gradient.y,
                      sums.slope.z + weight * at.gradient.z};
        for (int k = 0; k < 6; ++k) sums.curvature[k] += weight * quadric.curvature[k];
    }
    make_linear(sums, sites.kind);
    return sums;
}

/// From sums to means, linear near the centroid; for an edge where the quadric crosses it, so that it is linear there
/// and not at the midpoint.
void LatticeFits::make_linear(Blend4& sums, const Kinds4& kind) const {
    const Float4 unit = sums.accepted > 0 ? 1 / sums.accepted : Float4{};
    const auto& k = sums.curvature;
    const Lanes3<Float4> edge = steps_.edge(kind);
    const Lanes3<Float4> turn{unit * (k[0] * edge.x + k[3] * edge.y + k[4] * edge.z),
                              unit * (k[3] * edge.x + k[1] * edge.y + k[5] * edge.z),
                              unit * (k[4] * edge.x + k[5] * edge.y + k[2] * edge.z)};
    const Lanes3<Float4> slope{unit * sums.slope.x, unit * sums.slope.y, unit * sums.slope.z};
    const Float4 height = unit * sums.height, steep = dot(slope, edge);
    const Float4 crossing = steep != 0 ? -height / steep : Float4{};
    const Float4 step = least(greatest(crossing, all_four(-0.5f)), all_four(0.5f));
    sums.slope = {slope.x + step * turn.x, slope.y + step * turn.y, slope.z + step * turn.z};
    sums.height = height - 0.5f * step * step * dot(turn, edge);
}

}  // namespace regionmesh
