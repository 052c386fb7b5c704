#include "smooth/lattice_smoother.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel_for.h"
#include "regionmesh/process.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

using smoothing::kLatticeMargin;

double largest_block(const LatticeFrame& frame, double reach) {
    if (reach > 0) return reach;
    const double coarsest = std::max({frame.spacing.x, frame.spacing.y, frame.spacing.z});
    return coarsest < smoothing::kAnisotropic * frame.finest() ? smoothing::kLargestBlock
                                                               : smoothing::kLargestBlockAnisotropic;
}

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
      margins_{kLatticeMargin, order.inner_margin},
      sites_(window_, order.frame),
      lines_(window_, sites_, margins_) {
    for (double size = largest_block(order.frame, options.reach); size >= smoothing::kSmallestBlock; size /= 2)
        levels_.emplace_back(sites_, estimates_,
                             LatticeLevel::Options{.size = size,
                                                   .takes_all = size / 2 < smoothing::kSmallestBlock,
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
    return is_last_ && done_before == window_.chunk_end() ? done_before : done_before - std::min(done_before, 1u);
}

bool LatticeSmoother::add(const Chunk& chunk, bool is_last, double next_low) {
    const Timer timer(report_.filter_seconds);
    is_last_ = is_last;
    const std::uint32_t number = window_.chunk_end();
    window_.add(chunk);
    next_low_.push_back(next_low);
    sites_.add_chunk(number);

    for (; made_ < one_behind(window_.chunk_end()); ++made_) sites_.end_normals(made_);
    std::uint32_t done = made_;
    for (int pass = 0; pass < LatticeSites::kNormalPasses; ++pass) {
        for (; averaged_[pass] < one_behind(done); ++averaged_[pass]) sites_.average_normals(pass, averaged_[pass]);
        done = averaged_[pass];
    }
    for (; added_ < done; ++added_) add_to_levels(added_);
    refine();
    const bool is_all = is_last_ && added_ == window_.chunk_end();
    while (placed_ < added_ && (is_all || last_layer_[placed_] < levels_.back().refined())) place(placed_++);
    for (; linked_ < one_behind(placed_); ++linked_) lines_.link(linked_);
    done = linked_;
    for (std::uint32_t sweep = 0; sweep < LatticeLines::kSweeps; ++sweep) {
        for (; swept_[sweep] < one_behind(done); ++swept_[sweep]) lines_.sweep(sweep, swept_[sweep], options_.threads);
        done = swept_[sweep];
    }
    for (; finished_ < done; ++finished_) finish(finished_);
    note_bytes();
    return true;
}

void LatticeSmoother::add_to_levels(std::uint32_t chunk) {
    const NumberRange vertices = window_.vertices_of(chunk);
    const double finest = order_.frame.finest(), origin = order_.frame.origin[order_.axis];
    const double next_low = (next_low_[chunk] - origin) / finest;
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) {
        const double along = (window_.origin[v][order_.axis] - origin) / finest;
        const NumberRange sites = sites_.of_vertex(v);
        for (std::uint32_t s = sites.first; s < sites.end; ++s)
            if (sites_.is_used(s))
                for (LatticeLevel& level : levels_) level.add(s, along);
    }
    // No site of the chunk lies beyond.
    last_layer_.push_back(std::isfinite(next_low) ? levels_.back().layer_of(next_low) : 0);
    const bool is_end = is_last_ && chunk + 1 == window_.chunk_end();
    for (LatticeLevel& level : levels_) level.seal_before(is_end ? level.layer_end() : level.layer_of(next_low));
}

void LatticeSmoother::refine() {
    const bool is_all = is_last_ && added_ == window_.chunk_end();
    for (LatticeLevel& level : levels_) level.refine(is_all);
}

/// Where the interface crosses the edge of a vertex.
Vec3 LatticeSmoother::position_on_edge(std::uint32_t v) const {
    const SiteEstimate& estimate = estimates_[sites_.first_of(v)];
    const SimplexEdges edges = edges_of(sites_.kind(v), spacing_);
    const double steep = dot(estimate.slope.wide(), edges.edges[0]);
    const double step = estimate.rest < 1 && steep != 0 ? -estimate.height / steep : 0;
    const double weight = std::clamp(0.5 + step, kLatticeMargin, 1 - kLatticeMargin);
    return position_in(simplex_in(window_, sites_, v), {1 - weight, weight, 0, 0}, order_.frame);
}

/// Puts the vertices of a chunk nearest to their interfaces.
void LatticeSmoother::place(std::uint32_t chunk) {
    constexpr std::uint32_t kTask = 4096;  // vertices
    const LatticeFrame& frame = order_.frame;
    const NumberRange vertices = window_.vertices_of(chunk);
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v) positions_.push_back(window_.origin[v]);
    estimates_.grow(std::max(estimates_.end(), sites_.of_chunk(chunk).end));  // sites that are not used are in no level
    const auto nearest_to_interfaces = [&](std::uint32_t v, const SimplexEdges& edges) {
        NearestPoint nearest{edges.count};
        const NumberRange sites = sites_.of_vertex(v);
        for (std::uint32_t s = sites.first; s < sites.end; ++s)
            if (estimates_[s].rest < 1 && dot(estimates_[s].slope, estimates_[s].slope) > 0)
                nearest.add(estimates_[s], edges);
        return nearest;
    };
    parallel_for((vertices.size() + kTask - 1) / kTask, options_.threads, [&](std::uint32_t task) {
        const std::uint32_t first = vertices.first + task * kTask, end = std::min(vertices.end, first + kTask);
        for (std::uint32_t v = first; v < end; ++v) {
            if (sites_.of_vertex(v).size() == 0) continue;
            if (sites_.kind(v) < kFirstTriangle) {
                positions_[v] = position_on_edge(v);
                continue;
            }
            const SimplexEdges edges = edges_of(sites_.kind(v), spacing_);
            const Barycentric weights = weights_of(nearest_to_interfaces(v, edges).solve(), edges.count);
            positions_[v] = position_in(simplex_in(window_, sites_, v),
                                        clamp_inside(weights, edges.count + 1, margins_.of(sites_.kind(v))), frame);
        }
    });
    for (std::uint32_t v = vertices.first; v < vertices.end; ++v)
        if (sites_.kind(v) >= kFirstTriangle)
            lines_.add(v, nearest_to_interfaces(v, edges_of(sites_.kind(v), spacing_)), positions_[v]);
    lines_.end_chunk();
}

void LatticeSmoother::finish(std::uint32_t chunk) {
    lines_.for_positions(chunk, [&](std::uint32_t v, Vec3 at) { positions_[v] = at; });
    note_chunk(window_, chunk, positions_, report_);
}

bool LatticeSmoother::next(Chunk& chunk) {
    if (released_ == finished_) return false;
    window_.copy_out(released_, positions_, chunk);
    ++released_;
    // Each stage reads one chunk back.
    const std::uint32_t last = released_ - 1, first = window_.vertices_of(last).first;
    window_.drop_before(released_);
    positions_.drop_before(first);
    estimates_.drop_before(std::min(sites_.first_of(first), estimates_.end()));
    sites_.drop_before(first);
    lines_.drop_before(last);
    last_layer_.drop_before(last);
    next_low_.drop_before(last);
    return true;
}

double LatticeSmoother::safe_high() const {
    if (is_last_ && released_ == window_.chunk_end()) return HUGE_VAL;
    return released_ == 0 ? order_.frame.origin[order_.axis] : next_low_[released_ - 1];
}

void LatticeSmoother::note_bytes() {
    report_.window_chunks = std::max(report_.window_chunks, window_.chunk_end() - released_);
    std::uint64_t bytes = window_.bytes() + sites_.bytes() + estimates_.bytes() + lines_.bytes() + positions_.bytes();
    for (const LatticeLevel& level : levels_) bytes += level.bytes();
    report_.window_bytes = std::max(report_.window_bytes, bytes);
}

}  // namespace regionmesh
