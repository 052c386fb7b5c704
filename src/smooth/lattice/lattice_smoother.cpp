#include "smooth/lattice/lattice_smoother.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel_for.h"
#include "base/parallel_invoke.h"
#include "base/reused_vector.h"
#include "cells/compact_cells.h"
#include "regionmesh/process.h"
#include "smooth/lattice/usual_reach.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

using smoothing::kLatticeMargin;

/// Weights are rounded: they stay above the margin for which the faces are proved to be embedded.
constexpr double kRoundedMargin = CompactCells::kInnerMargin + 1e-6;

double largest_block(const LatticeFrame& frame, double reach) { return reach > 0 ? reach : usual_reach(frame.spacing); }

/// Sites whose estimates vertices in the box need, in finest spacings from the origin: sweeps of lines reach beyond it.
Box box_of_sites(const ChunkOrder& order) {
    constexpr double kCells = LatticeLines::kSweeps + 2;
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = order.frame.spacing[axis], origin = order.frame.origin[axis];
        box.low[axis] = (order.wanted.low[axis] - origin - kCells * spacing) / order.frame.finest();
        box.high[axis] = (order.wanted.high[axis] - origin + kCells * spacing) / order.frame.finest();
    }
    return box;
}

}  // namespace

/// Fits lie within NearRuns::kRings blocks of a vertex and read whole blocks within as many of theirs. Normals reach
/// over the faces of a vertex and the passes; sweeps of lines move on by a cell each, over the faces of the last.
std::array<std::uint32_t, 3> lattice_reach(const SmoothOptions& options, const LatticeFrame& frame) {
    constexpr std::uint32_t kBlocks = 2 * NearRuns::kRings + 1;
    constexpr std::uint32_t kCells = 1 + LatticeSites::kNormalPasses + LatticeLines::kSweeps + 1;
    const double block = largest_block(frame, options.reach);
    std::array<std::uint32_t, 3> reach{};
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = frame.spacing[axis] / frame.finest();
        reach[axis] = static_cast<std::uint32_t>(std::ceil(kBlocks * std::max(block / spacing, 1.0))) + kCells + 1;
    }
    return reach;
}

LatticeSmoother::LatticeSmoother(const SmoothOptions& options, const ChunkOrder& order)
    : options_(options),
      order_(order),
      spacing_(order.frame.spacing / order.frame.finest()),
      margins_{kLatticeMargin, order.cells == CellKind::kCompact ? kRoundedMargin : 0},
      sites_(order.frame),
      lines_(order.frame, margins_) {
    first_weight_.push_back(0);
    for (double size = largest_block(order.frame, options.reach); size >= smoothing::kSmallestBlock; size /= 2)
        levels_.emplace_back(sites_, estimates_,
                             LatticeLevel::Options{.size = size,
                                                   .takes_all = size / 2 < smoothing::kSmallestBlock,
                                                   .cells = order.cells,
                                                   .before = levels_.empty() ? nullptr : &levels_.back(),
                                                   .sweep_axis = order.axis,
                                                   .threads = options.threads,
                                                   .wanted = box_of_sites(order)});
}

/// Measured on a surface without faces: the lag depends on the blocks and on the thickness of a chunk only.
std::uint32_t LatticeSmoother::most_chunks() const {
    LatticeSmoother empty(options_, order_);
    const double block = largest_block(order_.frame, options_.reach) * order_.frame.finest();
    const auto chunks = static_cast<std::uint32_t>(16 * std::max(1.0, block / order_.thickness)) + 64;
    std::uint32_t most = 0;
    Chunk chunk;
    for (std::uint32_t n = 0; n < chunks; ++n) {
        const double low = order_.frame.origin[order_.axis] + (n + 1) * order_.thickness;
        [[maybe_unused]] const bool is_added = empty.add({}, false, low);
        most = std::max(most, n + 1 - empty.released_);
        while (empty.next(chunk)) {
        }
    }
    return most;
}

std::uint32_t LatticeSmoother::one_behind(std::uint32_t done_before) const {
    return is_last_ && done_before == chunks_.end() ? done_before : done_before - std::min(done_before, 1u);
}

bool LatticeSmoother::add(const Chunk& chunk, bool is_last, double next_low) {
    const Timer timer(report_.filter_seconds);
    is_last_ = is_last;
    std::vector<LatticeVertex>& vertices = parts_.vertices;
    clear_reused(vertices);
    assert(chunk.simplices.size() == chunk.vertices.size());
    for (std::size_t v = 0; v < chunk.vertices.size(); ++v)
        vertices.push_back({simplex_of(chunk.simplices[v]), chunk.vertices[v].sides});
    next_low_.push_back(next_low);
    parallel_invoke(
        options_.threads, [&] { chunks_.push_back(chunk, vertices); }, [&] { sites_.add(chunk, vertices); });

    for (; made_ < one_behind(chunks_.end()); ++made_) sites_.end_normals(made_);
    std::uint32_t done = made_;
    for (int pass = 0; pass < LatticeSites::kNormalPasses; ++pass) {
        for (; averaged_[pass] < one_behind(done); ++averaged_[pass]) sites_.average_normals(pass, averaged_[pass]);
        done = averaged_[pass];
    }
    for (; added_ < done; ++added_) add_to_levels(added_);
    refine();
    const bool is_all = is_last_ && added_ == chunks_.end();
    while (placed_ < added_ && (is_all || last_layer_[placed_] < levels_.back().refined())) place(placed_++);
    for (; linked_ < one_behind(placed_); ++linked_) lines_.link(linked_, chunks_, parts_);
    done = linked_;
    for (std::uint32_t sweep = 0; sweep < LatticeLines::kSweeps; ++sweep) {
        for (; swept_[sweep] < one_behind(done); ++swept_[sweep]) lines_.sweep(sweep, swept_[sweep], options_.threads);
        done = swept_[sweep];
    }
    note_bytes();
    return true;
}

void LatticeSmoother::add_to_levels(std::uint32_t chunk) {
    const LatticeFrame& frame = order_.frame;
    const double finest = frame.finest(), origin = frame.origin[order_.axis];
    const double next_low = (next_low_[chunk] - origin) / finest;
    chunks_.unpack_vertices(chunk, parts_.vertices);
    for (const LatticeVertex& vertex : parts_.vertices) {
        const double along = (centroid_along(order_.axis, vertex.simplex, frame) - origin) / finest;
        const NumberRange sites{added_sites_, added_sites_ + LatticeSites::count_of(vertex.simplex)};
        for (LatticeLevel& level : levels_) level.add(sites, along);
        added_sites_ = sites.end;
    }
    // No site of the chunk lies beyond.
    last_layer_.push_back(std::isfinite(next_low) ? levels_.back().layer_of(next_low) : 0);
    const bool is_end = is_last_ && chunk + 1 == chunks_.end();
    for (LatticeLevel& level : levels_) level.seal_before(is_end ? level.layer_end() : level.layer_of(next_low));
}

void LatticeSmoother::refine() {
    const bool is_all = is_last_ && added_ == chunks_.end();
    for (LatticeLevel& level : levels_) level.refine(is_all);
    drop_sites();
}

/// Sites that have been added to the levels, and that none of them reads any more.
void LatticeSmoother::drop_sites() {
    std::uint32_t first = added_sites_;
    for (const LatticeLevel& level : levels_) first = level.first_read(first);
    sites_.drop_before(first);
}

/// Where the interface crosses the edge of a vertex.
double LatticeSmoother::weight_on_edge(int kind, std::uint32_t site) const {
    const SiteEstimate& estimate = estimates_[site];
    const double steep = dot(estimate.slope.wide(), edges_of(kind, spacing_).edges[0]);
    const double step = estimate.rest < 1 && steep != 0 ? -estimate.height / steep : 0;
    return std::clamp(0.5 + step, kLatticeMargin, 1 - kLatticeMargin);
}

/// Puts the vertices of a chunk nearest to their interfaces.
void LatticeSmoother::place(std::uint32_t chunk) {
    constexpr std::uint32_t kTask = 4096;  // vertices
    chunks_.unpack_vertices(chunk, parts_.vertices);
    const std::vector<LatticeVertex>& vertices = parts_.vertices;
    const auto [first_site, end_site] = sites_.of_chunk(chunk);
    estimates_.grow(std::max(estimates_.end(), end_site));  // sites that are not used are in no level
    struct Place {
        std::uint32_t site, weight;
    };
    std::vector<Place> places;
    Place next{first_site, weights_.end()};
    for (const LatticeVertex& vertex : vertices) {
        places.push_back(next);
        next.site += LatticeSites::count_of(vertex.simplex);
        if (!LatticeLines::has(vertex.simplex)) ++next.weight;
    }
    weights_.grow(next.weight);
    const auto count = static_cast<std::uint32_t>(vertices.size());
    for_each_index(count, kTask, options_.threads, [&](std::uint32_t v) {
        const LatticeSimplex& simplex = vertices[v].simplex;
        if (LatticeLines::has(simplex) || LatticeSites::count_of(simplex) == 0) return;
        const double weight = weight_on_edge(simplex.kind, places[v].site);
        weights_[places[v].weight] = rounded({1 - weight, weight, 0, 0}, 2)[0];
    });
    for (std::uint32_t v = 0; v < count; ++v)
        if (LatticeLines::has(vertices[v].simplex)) place_on_line(vertices[v].simplex, places[v].site);
    lines_.end_chunk();
    first_weight_.push_back(weights_.end());
    estimates_.drop_before(end_site);
    sites_.drop_chunks_before(chunk + 1);
}

void LatticeSmoother::place_on_line(const LatticeSimplex& simplex, std::uint32_t first_site) {
    const SimplexEdges edges = edges_of(simplex.kind, spacing_);
    NearestPoint nearest{edges.count};
    const std::uint32_t end = first_site + LatticeSites::count_of(simplex);
    for (std::uint32_t s = first_site; s < end; ++s)
        if (estimates_[s].rest < 1 && dot(estimates_[s].slope, estimates_[s].slope) > 0)
            nearest.add(estimates_[s], edges);
    const Barycentric weights = weights_of(nearest.solve(), edges.count);
    const Barycentric inside = clamp_inside(weights, edges.count + 1, margins_.of(simplex.kind));
    lines_.add(simplex, nearest, rounded(inside, edges.count + 1));
}

/// The chunk that went in, with its vertices at their final positions.
void LatticeSmoother::move_vertices(std::uint32_t chunk, Chunk& moved) {
    const LatticeFrame& frame = order_.frame;
    chunks_.unpack(chunk, parts_);
    moved.clear();
    clear_reused(before_);
    clear_reused(after_);
    before_.insert(before_.end(), carried_before_.begin(), carried_before_.end());
    after_.insert(after_.end(), carried_after_.begin(), carried_after_.end());
    std::uint32_t weight = first_weight_[chunk], node = lines_.first_of(chunk);
    for (const auto& [simplex, sides] : parts_.vertices) {
        const Vec3 origin = centroid_in(simplex, frame);
        Vec3 at = origin;
        if (LatticeLines::has(simplex)) {
            at = lines_.position(node++);
        } else {
            const std::uint32_t second = weights_[weight++];
            if (second > 0) at = position_in(simplex, FixedWeights{second, 0, 0}, frame);
        }
        before_.push_back(origin);
        after_.push_back(at);
        moved.vertices.push_back({at, sides});
    }
    moved.carried = parts_.carried;
    std::swap(moved.faces, parts_.faces);
    std::swap(moved.active, parts_.active);
    note_chunk({moved.carried, before_, after_, moved.faces}, report_);
    carried_before_.clear();
    carried_after_.clear();
    for (const std::uint32_t local : moved.active) {
        carried_before_.push_back(before_[local]);
        carried_after_.push_back(after_[local]);
    }
}

bool LatticeSmoother::next(Chunk& chunk) {
    if (released_ == swept_[LatticeLines::kSweeps - 1]) return false;
    move_vertices(released_, chunk);
    weights_.drop_before(first_weight_[released_ + 1]);
    ++released_;
    const std::uint32_t last = released_ - 1;
    chunks_.drop_before(released_);
    first_weight_.drop_before(last);
    // Sweeps read one chunk back.
    lines_.drop_before(last);
    last_layer_.drop_before(last);
    next_low_.drop_before(last);
    return true;
}

double LatticeSmoother::safe_high() const {
    if (is_last_ && released_ == chunks_.end()) return HUGE_VAL;
    return released_ == 0 ? order_.frame.origin[order_.axis] : next_low_[released_ - 1];
}

void LatticeSmoother::note_bytes() {
    report_.window_chunks = std::max(report_.window_chunks, chunks_.end() - released_);
    std::uint64_t bytes = chunks_.bytes() + sites_.bytes() + estimates_.bytes() + lines_.bytes() + weights_.bytes();
    for (const LatticeLevel& level : levels_) bytes += level.bytes();
    report_.window_bytes = std::max(report_.window_bytes, bytes);
}

}  // namespace regionmesh
