#include "smooth/lattice/lattice_level.h"

#include <algorithm>
#include <utility>

#include "base/parallel_for.h"

namespace regionmesh {

LatticeLevel::LatticeLevel(const LatticeSites& sites, SlidingPages<SiteEstimate>& estimates, const Options& options)
    : sites_(sites),
      estimates_(estimates),
      options_(options),
      blocks_(sites.frame(), options.size, options.sweep_axis),
      fits_(sites, blocks_, {.size = options.size, .takes_all = options.takes_all, .cells = options.cells}) {}

void LatticeLevel::add(NumberRange sites, double coordinate) {
    if (sites.size() == 0) return;
    const std::int64_t number = layer_of(coordinate);
    while (layer_end() <= number) layers_.emplace_back();
    Layer& layer = layers_[number - first_layer_];
    layer.first_site = std::min(layer.first_site, sites.first);
    layer.site_end = sites.end;
    if (!layer.waiting.empty() && layer.waiting.back().end == sites.first)
        layer.waiting.back().end = sites.end;
    else
        layer.waiting.push_back(sites);
}

std::uint32_t LatticeLevel::first_read(std::uint32_t end) const {
    std::uint32_t first = end;
    for (const Layer& layer : layers_) first = std::min(first, layer.first_site);
    return first;
}

void LatticeLevel::seal_before(std::int64_t end) {
    whole_ = std::max(whole_, end);
    while (layer_end() < whole_) layers_.emplace_back();
}

/// Sorts the sites of a layer into rows and blocks.
void LatticeLevel::sort(Layer& layer) {
    for (const NumberRange& range : layer.waiting)
        for (std::uint32_t s = range.first; s < range.end; ++s) {
            if (!sites_.is_used(s)) continue;
            const std::size_t n = blocks_.cell_of(sites_[s].centroid, blocks_.row_axis) / LatticeBlocks::kCells;
            if (layer.rows.size() <= n) layer.rows.resize(n + 1);
            layer.rows[n].sites.push_back(s);
        }
    layer.waiting = {};
    parallel_for(static_cast<std::uint32_t>(layer.rows.size()), options_.threads, [&](std::uint32_t n) {
        if (!layer.rows[n].sites.empty()) layer.rows[n].sort(sites_, blocks_);
    });
}

void LatticeLevel::refine(bool is_last) {
    const std::int64_t end = is_last ? whole_ : whole_ - 2 * kRings;
    const auto is_decided = [&](std::int64_t layer) {
        const double last = (static_cast<double>(layer) + 0.99999) * blocks_.size_along(blocks_.layer_axis);
        return is_last || !options_.before || options_.before->layer_of(last) < options_.before->refined();
    };
    for (; refined_ < end && is_decided(refined_); ++refined_) {
        // Sorted only now, since samples and fits take more room than sites.
        for (; sorted_ < std::min(whole_, refined_ + 2 * kRings + 1); ++sorted_) sort(layers_[sorted_ - first_layer_]);
        refine_layer(refined_);
        // Layers that come read fits of the last few. The coarsest level has made them all, so that none of them needs
        // samples and sites of layers farther off.
        const int held = options_.before ? 2 * kRings : kRings;
        while (first_layer_ + held <= refined_) {
            layers_.pop_front();
            ++first_layer_;
        }
    }
}

NearRuns LatticeLevel::near_runs(std::int64_t layer, std::uint32_t row) {
    std::array<std::vector<LatticeRow>*, 2 * kRings + 1> layers{};
    for (int n = 0; n < 2 * kRings + 1; ++n) {
        const std::int64_t l = layer + n - kRings;
        if (l >= first_layer_ && l < layer_end()) layers[n] = &layers_[l - first_layer_].rows;
    }
    return {layers, static_cast<std::int32_t>(row), blocks_};
}

/// Fits are made when a site that needs them is refined: where a coarser level has decided there are none.
void LatticeLevel::refine_layer(std::int64_t layer) {
    auto& [waiting, first_site, site_end, rows] = layers_[layer - first_layer_];
    if (site_end > estimates_.end()) estimates_.grow(site_end);
    const auto count = static_cast<std::uint32_t>(rows.size());
    std::vector<OpenRow> open(count);
    parallel_for(count, options_.threads, [&](std::uint32_t r) { find_open(layer, r, open[r]); });
    const auto want = [](LatticeRow& row, std::uint32_t run) {
        if (row.runs[run].is_wanted) return;
        row.runs[run].is_wanted = 1;
        row.wanted.push_back(run);
    };
    for (const OpenRow& row : open)
        for (const FitPlace& place : row.fits) want(*place.row, place.run);
    for (std::uint32_t r = 0; r < count; ++r)
        for (const std::uint32_t run : open[r].early) want(rows[r], run);
    make_wanted_fits(layer);
    parallel_for(count, options_.threads, [&](std::uint32_t r) {
        const auto& [runs, first_fit, fits, early] = open[r];
        for (std::size_t n = 0; n < runs.size(); ++n)
            fits_.blend(rows[r], runs[n], std::span(fits).subspan(first_fit[n], first_fit[n + 1] - first_fit[n]),
                        estimates_);
    });
}

bool LatticeLevel::is_wanted(const LatticeRow& row, const LatticeRun& run, int rings) const {
    const LatticePoint corner = blocks_.corner_of_block(sites_[row.sites[run.site]].centroid);
    const LatticeSteps& steps = blocks_.steps;
    const LatticePoint low = steps.moved(corner, blocks_.from_units(run.low));
    const LatticePoint high = steps.moved(corner, blocks_.from_units(run.high));
    for (int axis = 0; axis < 3; ++axis) {
        const double margin = rings * blocks_.size_along(axis);
        if (steps.coordinate(high, axis) < options_.wanted.low[axis] - margin) return false;
        if (steps.coordinate(low, axis) > options_.wanted.high[axis] + margin) return false;
    }
    return true;
}

void LatticeLevel::find_open(std::int64_t layer, std::uint32_t row, OpenRow& open) {
    const LatticeRow& own = layers_[layer - first_layer_].rows[row];
    NearRuns near = near_runs(layer, row);
    open.first_fit.push_back(0);
    for (std::uint32_t run = 0; run + 1 < own.runs.size(); ++run) {
        const auto is_open = [&](std::uint32_t site) { return estimates_[site].rest > 0; };
        const auto begin = own.sites.begin();
        if (!is_wanted(own, own.runs[run], 0)) {
            // On finer levels fits are made later, too, as others ask for them. Here those that may be asked for lie
            // within kBlend of a block that reaches into the box.
            if (!options_.before && is_wanted(own, own.runs[run], kRings + 1)) open.early.push_back(run);
            continue;
        }
        if (std::none_of(begin + own.runs[run].site, begin + own.runs[run + 1].site, is_open)) continue;
        fits_.find_near(own, run, near.of(own.keys[run]), open.fits);
        open.runs.push_back(run);
        open.first_fit.push_back(static_cast<std::uint32_t>(open.fits.size()));
    }
}

void LatticeLevel::make_wanted_fits(std::int64_t layer) {
    std::vector<std::pair<std::int64_t, std::uint32_t>> places;  // layers and rows
    for (std::int64_t l = std::max(first_layer_, layer - kRings); l < std::min(layer_end(), layer + kRings + 1); ++l) {
        const std::vector<LatticeRow>& rows = layers_[l - first_layer_].rows;
        for (std::uint32_t r = 0; r < rows.size(); ++r)
            if (!rows[r].wanted.empty()) places.emplace_back(l, r);
    }
    parallel_for(static_cast<std::uint32_t>(places.size()), options_.threads, [&](std::uint32_t n) {
        const auto [l, r] = places[n];
        LatticeRow& row = layers_[l - first_layer_].rows[r];
        std::sort(row.wanted.begin(), row.wanted.end());
        NearRuns near = near_runs(l, r);
        for (std::uint32_t run : row.wanted) fits_.make(row, run, near.of(row.keys[run]));
        row.wanted = {};
    });
}

std::size_t LatticeLevel::bytes() const {
    std::size_t sum = 0;
    for (const Layer& layer : layers_) {
        sum += layer.waiting.capacity() * sizeof(NumberRange);
        for (const LatticeRow& row : layer.rows) sum += row.bytes();
    }
    return sum;
}

}  // namespace regionmesh
