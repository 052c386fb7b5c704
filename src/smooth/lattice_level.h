// One scale of the lattice filter: overlapping quadrics that explain the labels near their centres.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "smooth/lattice_quadric.h"
#include "smooth/lattice_sites.h"

namespace regionmesh {

/// The interface near a site, linear: height over the surface at the centroid in finest spacings, and the height's
/// gradient.
struct SiteEstimate {
    float height = 0;
    Float3 slope;
    float rest = 1;  // share that no scale has decided yet; height and slope are sums with weights 1 - rest
};

/// Cuts space into blocks of about `size` and fits one quadric to each sheet of an interface in a block, from the sites
/// within kReach blocks. A quadric is accepted if it passes through (nearly) every simplex within kBlend blocks: then
/// it is a surface that explains the labels there. Works layer by layer of blocks along the sweep.
class LatticeLevel {
public:
    static constexpr float kReach = 2.2f, kBlend = 1.3f;  // radii in blocks
    static constexpr int kRings = 2;                      // blocks on each side that are looked at

    struct Options {
        double size;             // of blocks in finest spacings; along an axis with wider spacing that spacing
        bool takes_all = false;  // accept every quadric: the finest scale
        const LatticeLevel* before = nullptr;  // the level that refines the same sites first
        int sweep_axis = 2;
        std::uint32_t threads = 0;
    };

    LatticeLevel(const LatticeSites& sites, SlidingArray<SiteEstimate>& estimates, const Options& options);

    /// The layer of blocks that a coordinate along the sweep lies in.
    std::int64_t layer_of(double coordinate) const { return place_of(coordinate, options_.sweep_axis) / kCells; }
    /// Adds a site whose normal is final, in order of number.
    void add(std::uint32_t site, double coordinate);
    /// Layers before `end` get no more sites.
    void seal_before(std::int64_t end);
    std::int64_t layer_end() const { return first_layer_ + static_cast<std::int64_t>(layers_.size()); }
    /// Gives accepted quadrics the rest of the estimates of each site, blended; as far as whole layers and the level
    /// before allow. `is_last`: all sites were added.
    void refine(bool is_last);
    /// Layers before this one are refined.
    std::int64_t refined() const { return refined_; }

    std::size_t bytes() const;

private:
    static constexpr int kCells =
        3;  // per block along each axis: sites of one kind of simplex in a cell are one sample

    struct Sample {
        LatticePoint position;
        Float3 normal;
        float count;
        std::uint8_t kind;
    };
    /// Samples of a row, one array for each coordinate, with room for four lanes behind the last.
    struct Samples {
        std::array<std::vector<std::uint32_t>, 3> at;
        std::array<std::vector<float>, 3> normal;
        std::vector<float> count;  // of sites
        std::vector<std::uint8_t> kind;

        std::uint32_t size() const { return static_cast<std::uint32_t>(kind.size()); }
        void push_back(const Sample& sample);
        LatticePoint position(std::uint32_t n) const { return {{at[0][n], at[1][n], at[2][n]}}; }
        Float3 normal_of(std::uint32_t n) const { return {normal[0][n], normal[1][n], normal[2][n]}; }
        void pad();
        std::size_t bytes() const { return kind.capacity() * (7 * sizeof(float) + 1); }
    };
    struct Fit {
        HeightQuadric quadric;
        float accepted = 0;  // 0 to 1; below 0: could not be fitted
    };
    /// Sites of one interface in one block. Ranges end where those of the next run begin.
    struct Run {
        std::uint32_t interface;
        std::uint32_t site, sample, fit;
        std::int32_t place;  // of the block along the row
        bool is_fitted = false;
    };
    struct Row {
        std::vector<std::uint32_t> sites;  // by run
        std::vector<Run> runs;             // by block, then interface; and one more at the end
        Samples samples;
        std::vector<Fit> fits;
    };
    struct Layer {
        std::vector<std::uint32_t> sites;  // until the layer is sorted
        std::vector<Row> rows;
    };
    struct Group {
        Float3 position, normal;  // sums
        float count;
        std::uint8_t direction;
    };
    struct RunPlace {
        std::int64_t layer;
        std::int32_t row;
        std::uint32_t run;  // in the row
    };
    struct LinearHeight {
        float height;
        Float3 slope;
    };

    double size_along(int axis) const { return axis == 0 ? size_.x : axis == 1 ? size_.y : size_.z; }
    std::int64_t place_of(double coordinate, int axis) const;
    std::int64_t cell_of(std::uint32_t site, int axis) const;
    Row& row(const RunPlace& at) { return layers_[at.layer - first_layer_].rows[at.row]; }
    void sort(Layer& layer);
    void fill_row(Row& row) const;
    void make_samples(Row& row, const std::vector<std::uint64_t>& keys) const;
    void make_fits(Row& row) const;
    std::vector<Group> groups_of(const Row& row, const Run& run) const;
    template <class Visit>
    void for_runs_near(const RunPlace& at, Visit&& visit);
    void refine_layer(std::int64_t layer);
    bool is_open(const Row& row, std::uint32_t run) const;
    void fit_run(const RunPlace& at);
    void choose(const RunPlace& at, const HeightQuadric& quadric, HeightSamples& chosen);
    float acceptance(const RunPlace& at, const HeightQuadric& quadric);
    std::vector<const Fit*>& fits_near(const RunPlace& at);
    void blend_run(const RunPlace& at);
    LinearHeight linear_height(const HeightQuadric& quadric, Float3 d, int kind) const;
    float distance2(Float3 d) const;

    const LatticeSites& sites_;
    SlidingArray<SiteEstimate>& estimates_;
    Options options_;
    Float3 spacing_, size_;  // of samples, of blocks; in finest spacings
    Float3 per_size_;        // inverses of size_
    std::int64_t first_layer_ = 0;
    std::int64_t whole_ = 0, sorted_ = 0,
                 refined_ = 0;  // ends of the layers that have all sites, are sorted, are refined
    std::deque<Layer> layers_;
};

}  // namespace regionmesh
