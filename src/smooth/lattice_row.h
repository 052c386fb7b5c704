// The sites of one row of blocks, and what fits are made from.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smooth/lattice_quadric.h"
#include "smooth/lattice_sites.h"

namespace regionmesh {

/// Blocks of about `size` finest spacings; along an axis with wider spacing that spacing. Rows of blocks run along one
/// axis, layers are square to the sweep.
struct LatticeBlocks {
    /// Per block along each axis: sites of one kind of simplex in a cell are one sample.
    static constexpr int kCells = 3;

    Float3 spacing, size;  // of samples, of blocks; in finest spacings
    Float3 per_size;       // inverses of size
    int layer_axis, row_axis, place_axis;

    LatticeBlocks(const LatticeFrame& frame, double block_size, int sweep_axis);

    /// Sites of one kind of simplex and one interface lie in different cells: each sample is a site.
    bool parts_sites() const {
        return size.x < kCells * spacing.x && size.y < kCells * spacing.y && size.z < kCells * spacing.z;
    }
    double size_along(int axis) const { return axis == 0 ? size.x : axis == 1 ? size.y : size.z; }
    /// The cell of a coordinate in finest spacings.
    std::int64_t cell_of(double coordinate, int axis) const;
    std::int64_t cell_of(const LatticePoint& p, int axis) const {
        return cell_of(p.at[axis] * LatticePoint::kStep, axis);
    }
    /// Square of a length measured in blocks.
    float distance2(Float3 d) const {
        const Float3 in_blocks{d.x * per_size.x, d.y * per_size.y, d.z * per_size.z};
        return dot(in_blocks, in_blocks);
    }

private:
    Vec3 cells_per_length_;
};

/// The axis along which a normal is longest, and its sign: sites of a block are parted by it.
inline std::uint8_t direction_of(Float3 normal) {
    const float sizes[3] = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const float signs[3] = {normal.x, normal.y, normal.z};
    const int axis = sizes[1] > sizes[0] ? (sizes[2] > sizes[1] ? 2 : 1) : (sizes[2] > sizes[0] ? 2 : 0);
    return static_cast<std::uint8_t>(2 * axis + (signs[axis] > 0));
}

using Short4 = std::uint16_t __attribute__((vector_size(8)));

/// Four samples. Lanes without one have no sites.
struct alignas(16) LatticeSamples {
    std::array<Unsigned4, 3> at;
    Lanes3<Float4> normal;
    Short4 count{};  // of sites
    Kinds4 kind{1, 1, 1, 1};

    LatticePoint position(int lane) const { return {{at[0][lane], at[1][lane], at[2][lane]}}; }
    Float3 normal_of(int lane) const { return {normal.x[lane], normal.y[lane], normal.z[lane]}; }
};

struct LatticeFit {
    HeightQuadric quadric;
    float accepted = 0;  // 0 to 1; below 0: could not be fitted
};

static_assert(sizeof(LatticeSamples) == 112);

/// Sites of one interface in one block. Ranges end where those of the next run begin.
struct LatticeRun {
    std::uint32_t site, samples = 0;
    std::uint32_t fit : 31 = 0;
    std::uint32_t is_wanted : 1 = 0;  // its fits are made, or will be
    Float3 low{}, high{};             // box of its sites, from the first of them

    void add(Float3 d) {
        low = {std::min(low.x, d.x), std::min(low.y, d.y), std::min(low.z, d.z)};
        high = {std::max(high.x, d.x), std::max(high.y, d.y), std::max(high.z, d.z)};
    }
};

/// By interface, then block along the row, which may lie up to two before the first.
constexpr std::uint64_t run_key(std::uint32_t interface, std::int64_t place) {
    return std::uint64_t{interface} << 32 | static_cast<std::uint32_t>(place + 2);
}

struct LatticeRow {
    std::vector<std::uint32_t> sites;     // in order of number, then by run
    std::vector<std::uint64_t> keys;      // of the runs, in order; and one above all at the end
    std::vector<LatticeRun> runs;         // and one more at the end
    std::vector<LatticeSamples> samples;  // none where each of them is a site (LatticeBlocks::parts_sites)
    std::vector<LatticeFit> fits;
    std::vector<std::uint32_t> wanted;  // runs whose fits are not made yet

    /// Sorts sites into runs and samples, and places the fits. Requires final normals.
    void sort(const LatticeSites& of, const LatticeBlocks& blocks);
    std::size_t bytes() const;

private:
    struct KeyedSite {
        std::uint64_t key;  // interface, block, direction, cell in the block, kind
        std::uint32_t site;
    };

    void sort_by_key(std::vector<KeyedSite>& keyed);
    void make_runs(const std::vector<KeyedSite>& keyed);
    void make_samples(const LatticeSites& of, const std::vector<KeyedSite>& keyed);
    void place_fits();
};

/// A run within kRings blocks of another of the same interface.
struct NearRun {
    LatticeRow* row;
    std::uint32_t run;
    std::array<std::int8_t, 3> offset;  // in blocks, by axis

    const LatticeRun& operator*() const { return row->runs[run]; }
    const LatticeRun& next() const { return row->runs[run + 1]; }
};

/// Finds the runs near those of a row, in the order of the row.
class NearRuns {
public:
    static constexpr int kRings = 2;  // blocks on each side that are looked at; as run_key() allows

    /// `layers` has a pointer to the rows of each layer within kRings, or null; `number` is that of the row in its
    /// layer.
    NearRuns(const std::array<std::vector<LatticeRow>*, 2 * kRings + 1>& layers, std::int32_t number,
             const LatticeBlocks& blocks);

    /// Of a run with this key, by layer, row and block; the run itself is one of them.
    std::span<const NearRun> of(std::uint64_t key);

private:
    struct Near {
        LatticeRow* row;
        const std::uint64_t* next;  // key of a run; none before it is asked for
        std::array<std::int8_t, 3> offset;
    };

    std::vector<Near> rows_;
    std::uint32_t interface_ = ~0u;
    int place_axis_;
    std::vector<NearRun> near_;  // as many as there can be
};

}  // namespace regionmesh
