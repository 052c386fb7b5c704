// One scale of the lattice filter: overlapping quadrics that explain the labels near their centres.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "smooth/lattice/lattice_fits.h"
#include "smooth/lattice/lattice_row.h"
#include "smooth/lattice/lattice_sites.h"

namespace regionmesh {

/// Cuts space into blocks of about `size` and fits one quadric to each sheet of an interface in a block. Works layer by
/// layer of blocks along the sweep.
class LatticeLevel {
public:
    struct Options {
        double size;             // size of blocks in finest spacings; along an axis with wider spacing that spacing
        bool takes_all = false;  // accept every quadric: the finest scale
        CellKind cells = CellKind::kTetrahedra;
        const LatticeLevel* before = nullptr;  // the level that refines the same sites first
        int sweep_axis = 2;
        std::uint32_t threads = 0;
        Box wanted;  // box in finest spacings: estimates of sites outside need not be made
    };

    LatticeLevel(const LatticeSites& sites, SlidingPages<SiteEstimate>& estimates, const Options& options);

    /// The layer of blocks that a coordinate along the sweep lies in.
    std::int64_t layer_of(double coordinate) const {
        return blocks_.cell_of(coordinate, blocks_.layer_axis) / LatticeBlocks::kCells;
    }
    /// Adds sites whose normals are final, in order of number, with the same coordinate along the sweep.
    void add(NumberRange sites, double coordinate);
    /// Layers before `end` get no more sites.
    void seal_before(std::int64_t end);
    std::int64_t layer_end() const { return first_layer_ + static_cast<std::int64_t>(layers_.size()); }
    /// Gives accepted quadrics the rest of the estimates of each site, blended; as far as whole layers and the level
    /// before allow. `is_last`: all sites were added.
    void refine(bool is_last);
    /// Layers before this one are refined.
    std::int64_t refined() const { return refined_; }
    /// Of the sites that were added, those before this one are not read any more; `end` if none is.
    std::uint32_t first_read(std::uint32_t end) const;

    std::size_t bytes() const;

private:
    static constexpr int kRings = NearRuns::kRings;

    struct Layer {
        std::vector<NumberRange> waiting;  // sites, until the layer is sorted
        std::uint32_t first_site = ~0u, site_end = 0;
        std::vector<LatticeRow> rows;
    };
    /// The fits near each run of a row that has open estimates.
    struct OpenRow {
        std::vector<std::uint32_t> runs, first_fit;  // one more at the end
        std::vector<FitPlace> fits;
        std::vector<std::uint32_t> early;  // runs near those wanted: their fits are made while the sites are held
    };

    void sort(Layer& layer);
    NearRuns near_runs(std::int64_t layer, std::uint32_t row);
    void refine_layer(std::int64_t layer);
    /// Whether the sites of a run reach into the box of sites that are wanted, with so many blocks round it.
    bool is_wanted(const LatticeRow& row, const LatticeRun& run, int rings) const;
    void find_open(std::int64_t layer, std::uint32_t row, OpenRow& open);
    void make_wanted_fits(std::int64_t layer);

    const LatticeSites& sites_;
    SlidingPages<SiteEstimate>& estimates_;
    Options options_;
    LatticeBlocks blocks_;
    LatticeFits fits_;
    std::int64_t first_layer_ = 0;
    std::int64_t whole_ = 0, sorted_ = 0,
                 refined_ = 0;  // ends of the layers that have all sites, are sorted, are refined
    std::deque<Layer> layers_;
};

}  // namespace regionmesh
