// The sites of one row of blocks, and what fits are made from.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smooth/lattice/lattice_quadric.h"
#include "smooth/lattice/lattice_sites.h"

namespace regionmesh {

/// Blocks of about `size` finest spacings; along an axis with wider spacing that spacing. Rows of blocks run along one
/// axis, layers are square to the sweep.
struct LatticeBlocks {
    /// Per block along each axis: sites of one kind of simplex in a cell are one sample.
    static constexpr int kCells = 3;

    Float3 spacing, size;  // spacing and size of samples, of blocks; in finest spacings
    Float3 per_size;       // inverses of size
    Float3 unit;           // unit of positions in a block, in finest spacings
    LatticeSteps steps;
    int layer_axis, row_axis, place_axis;

    LatticeBlocks(const LatticeFrame& frame, double block_size, int sweep_axis);

    /// Sites of one kind of simplex and one interface lie in different cells: each sample is a site.
    bool parts_sites() const {
        return size.x < kCells * spacing.x && size.y < kCells * spacing.y && size.z < kCells * spacing.z;
    }
    double size_along(int axis) const { return axis == 0 ? size.x : axis == 1 ? size.y : size.z; }
    /// The cell of a coordinate in finest spacings.
    std::int64_t cell_of(double coordinate, int axis) const;
    std::int64_t cell_of(const LatticePoint& p, int axis) const { return cell_of(steps.coordinate(p, axis), axis); }
    std::int64_t block_of(const LatticePoint& p, int axis) const { return cell_of(p, axis) / kCells; }

    /// Positions in a block have 16 bits along each axis: they count from its corner in units, which are powers of two
    /// of steps.
    std::uint32_t corner_of(std::int64_t block, int axis) const {
        constexpr std::int64_t kBefore = 16;  // units; the small shift of cell_of is less
        const auto begin = static_cast<std::int64_t>(static_cast<double>(block) * size_along(axis) / steps.size(axis));
        return static_cast<std::uint32_t>(begin - (kBefore << unit_bits_[axis]));
    }
    LatticePoint corner_of_block(const LatticePoint& p) const {
        const auto along = [&](int axis) { return corner_of(block_of(p, axis), axis); };
        return {{along(0), along(1), along(2)}};
    }
    /// In finest spacings from the corner.
    Float3 from_units(Float3 p) const { return {unit.x * p.x, unit.y * p.y, unit.z * p.z}; }
    Float3 from_units(const std::array<std::uint16_t, 3>& p) const {
        return from_units(Float3{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    /// Rounded to the nearest unit, down, and up.
    std::uint16_t in_units(const LatticePoint& p, const LatticePoint& corner, int axis) const {
        return rounded(p, corner, axis, (1u << unit_bits_[axis]) >> 1);
    }
    std::uint16_t units_below(const LatticePoint& p, const LatticePoint& corner, int axis) const {
        return rounded(p, corner, axis, 0);
    }
    std::uint16_t units_above(const LatticePoint& p, const LatticePoint& corner, int axis) const {
        return rounded(p, corner, axis, (1u << unit_bits_[axis]) - 1);
    }

    /// Square of a length measured in blocks.
    float distance2(Float3 d) const {
        const Float3 in_blocks{d.x * per_size.x, d.y * per_size.y, d.z * per_size.z};
        return dot(in_blocks, in_blocks);
    }

private:
    std::uint16_t rounded(const LatticePoint& p, const LatticePoint& corner, int axis, std::uint32_t up) const {
        return static_cast<std::uint16_t>((p.at[axis] - corner.at[axis] + up) >> unit_bits_[axis]);
    }

    Vec3 cells_per_length_;
    std::array<int, 3> unit_bits_{};
};

/// The axis along which a normal is longest, and its sign: sites of a block are parted by it.
inline std::uint8_t direction_of(Float3 normal) {
    const float sizes[3] = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const float signs[3] = {normal.x, normal.y, normal.z};
    const int axis = sizes[1] > sizes[0] ? (sizes[2] > sizes[1] ? 2 : 1) : (sizes[2] > sizes[0] ? 2 : 0);
    return static_cast<std::uint8_t>(2 * axis + (signs[axis] > 0));
}

/// Four samples of one block. Lanes without one have no sites.
struct LatticeSamples {
    static constexpr float kNormalUnit = 1.0f / 32767;

    std::uint16_t at[3][4];     // LatticeBlocks::in_units
    std::int16_t normal[3][4];  // in kNormalUnit
    std::uint16_t count[4]{};   // count of sites
    Kinds4 kind{1, 1, 1, 1};

    Lanes3<Float4> positions() const { return {as_floats(at[0]), as_floats(at[1]), as_floats(at[2])}; }
    Lanes3<Float4> normals() const { return {as_floats(normal[0]), as_floats(normal[1]), as_floats(normal[2])}; }
    Float4 counts() const { return as_floats(count); }
    Float3 position_of(int lane) const { return lane_of(positions(), lane); }
    Float3 normal_of(int lane) const { return kNormalUnit * lane_of(normals(), lane); }

private:
    using Signed4 = std::int16_t __attribute__((vector_size(8)));
    using Natural4 = std::uint16_t __attribute__((vector_size(8)));
    static Float4 as_floats(const std::int16_t (&four)[4]) { return as_floats(load<Signed4>(four)); }
    static Float4 as_floats(const std::uint16_t (&four)[4]) { return as_floats(load<Natural4>(four)); }
    template <class Four>
    static Float4 as_floats(Four four) {
        return __builtin_convertvector(__builtin_convertvector(four, Lane4), Float4);
    }
    static Float3 lane_of(const Lanes3<Float4>& p, int lane) { return {p.x[lane], p.y[lane], p.z[lane]}; }
};

struct LatticeFit {
    HeightQuadric quadric;
    float accepted = 0;  // 0 to 1; below 0: could not be fitted
};

static_assert(sizeof(LatticeSamples) == 60);

/// Sites of one interface in one block. Ranges end where those of the next run begin.
struct LatticeRun {
    std::uint32_t site, samples = 0;
    std::uint32_t fit : 31 = 0;
    std::uint32_t is_wanted : 1 = 0;             // its fits are made, or will be
    std::array<std::uint16_t, 3> low{}, high{};  // box of its sites, in units from the corner of the block
};

/// By interface, then block along the row, which may lie up to two before the first.
constexpr std::uint64_t run_key(std::uint32_t interface, std::int64_t place) {
    return std::uint64_t{interface} << 32 | static_cast<std::uint32_t>(place + 2);
}

struct LatticeRow {
    std::vector<std::uint32_t> sites;     // sites in order of number, then by run
    std::vector<std::uint64_t> keys;      // keys of the runs, in order; and one above all at the end
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
    void make_samples(const LatticeSites& of, const LatticeBlocks& blocks, const std::vector<KeyedSite>& keyed);
    void place_fits(const LatticeSites& of, const LatticeBlocks& blocks);
};

/// A run within kRings blocks of another of the same interface.
struct NearRun {
    LatticeRow* row;
    std::uint32_t run;
    std::array<std::int8_t, 3> offset;  // offset in blocks, by axis

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
    std::vector<NearRun> near_;  // room for as many as there can be
};

}  // namespace regionmesh
