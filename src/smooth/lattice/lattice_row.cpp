#include "smooth/lattice/lattice_row.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

namespace regionmesh {
namespace {

std::int16_t in_normal_units(float x) {
    return static_cast<std::int16_t>(static_cast<int>(32768.5f + x * (1 / LatticeSamples::kNormalUnit)) - 32768);
}

/// Zero where the length is not a number above 0, as in lattices whose spacings differ by many powers of ten.
Float3 unit_vector(Float3 v) {
    const float size = length(v);
    return size > 0 ? (1 / size) * v : Float3{};
}

/// Groups of sites in a block are one sheet above this cosine.
constexpr float kJoins = 0.7f;

/// Where parts of a key begin: 27 bits of interface, 21 of block, 16 of the rest.
constexpr int kInterfaceBit = 37, kPlaceBit = 16;
constexpr std::uint32_t kMostPlaces = (1u << (kInterfaceBit - kPlaceBit)) - 1;

/// Samples of a block that face about the same way.
struct Group {
    Float3 position, normal;  // sums
    float count;
    std::uint8_t direction;
};

/// By direction; a group that faces about the same way as a larger one joins it. Positions are sums of offsets from the
/// first sample, in units.
std::vector<Group>& groups_of(std::span<const LatticeSamples> samples) {
    thread_local std::vector<Group> groups, joined;
    groups.clear();
    const Float3 first = samples[0].position_of(0);
    for (const LatticeSamples& four : samples)
        for (int lane = 0; lane < 4 && four.count[lane] > 0; ++lane) {
            const Float3 normal = four.normal_of(lane);
            const std::uint8_t direction = direction_of(normal);
            auto group =
                std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.direction == direction; });
            if (group == groups.end()) group = groups.insert(group, {{}, {}, 0, direction});
            const auto count = static_cast<float>(four.count[lane]);
            group->position += count * (four.position_of(lane) - first);
            group->normal += count * normal;
            group->count += count;
        }
    if (groups.size() == 1) return groups;
    std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return std::tuple(-a.count, a.direction) < std::tuple(-b.count, b.direction);
    });
    joined.clear();
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

}  // namespace

LatticeBlocks::LatticeBlocks(const LatticeFrame& frame, double block_size, int sweep_axis)
    : steps(frame.spacing / frame.finest()),
      layer_axis(sweep_axis),
      row_axis((sweep_axis + 2) % 3),
      place_axis((sweep_axis + 1) % 3) {
    spacing = Float3(frame.spacing / frame.finest());
    const auto least = static_cast<float>(block_size);
    size = {std::max(least, spacing.x), std::max(least, spacing.y), std::max(least, spacing.z)};
    per_size = {1 / size.x, 1 / size.y, 1 / size.z};
    constexpr double kMostUnits = 65000;
    constexpr int kMostUnitBits = 31;  // positions have 32
    for (int axis = 0; axis < 3; ++axis) {
        cells_per_length_[axis] = kCells / size_along(axis);
        int& bits = unit_bits_[axis];
        while (bits < kMostUnitBits && std::ldexp(kMostUnits, bits) * steps.size(axis) < size_along(axis)) ++bits;
    }
    const auto unit_along = [&](int axis) { return std::ldexp(steps.size(axis), unit_bits_[axis]); };
    unit = {unit_along(0), unit_along(1), unit_along(2)};
}

/// The small shift keeps centroids on a plane between cells on one side of it, whatever their rounding. Coordinates are
/// not negative, so that truncation is the floor.
std::int64_t LatticeBlocks::cell_of(double coordinate, int axis) const {
    return static_cast<std::int64_t>(coordinate * cells_per_length_[axis] + 1e-4);
}

void LatticeRow::sort(const LatticeSites& of, const LatticeBlocks& blocks) {
    constexpr std::uint32_t kCells = LatticeBlocks::kCells;
    thread_local std::vector<KeyedSite> keyed;
    keyed.clear();
    for (std::uint32_t s : sites) {
        const LatticeSite& site = of[s];
        const auto cell = [&](int axis) { return static_cast<std::uint32_t>(blocks.cell_of(site.centroid, axis)); };
        const std::uint32_t along = cell(blocks.place_axis);
        std::uint32_t rest = direction_of(site.normal);
        rest = rest * kCells + cell(blocks.layer_axis) % kCells;
        rest = rest * kCells + cell(blocks.row_axis) % kCells;
        rest = rest * kCells + along % kCells;
        rest = rest * kKindCount + site.kind();
        keyed.push_back(
            {std::uint64_t{site.interface()} << kInterfaceBit | std::uint64_t{along / kCells} << kPlaceBit | rest, s});
    }
    sort_by_key(keyed);
    for (std::size_t n = 0; n < keyed.size(); ++n) sites[n] = keyed[n].site;
    make_runs(keyed);
    make_samples(of, blocks, keyed);
    place_fits(of, blocks);
    if (blocks.parts_sites()) samples.clear();
    sites.shrink_to_fit();
    keys.shrink_to_fit();
    runs.shrink_to_fit();
    samples.shrink_to_fit();
    fits.shrink_to_fit();
}

/// Stable. Least significant digit first; digits that all keys share need no pass.
void LatticeRow::sort_by_key(std::vector<KeyedSite>& keyed) {
    constexpr std::size_t kFew = 96;
    if (keyed.size() < kFew) {
        std::sort(keyed.begin(), keyed.end(), [](const KeyedSite& a, const KeyedSite& b) {
            return a.key != b.key ? a.key < b.key : a.site < b.site;
        });
        return;
    }
    thread_local std::vector<KeyedSite> other;
    other.resize(keyed.size());
    std::uint64_t differs = 0;
    for (const KeyedSite& item : keyed) differs |= item.key ^ keyed[0].key;
    for (int shift = 0; shift < 64; shift += 8) {
        if ((differs >> shift & 255) == 0) continue;
        std::array<std::uint32_t, 256> place{};
        for (const KeyedSite& item : keyed) ++place[item.key >> shift & 255];
        std::uint32_t next = 0;
        for (std::uint32_t& at : place) next += std::exchange(at, next);
        for (const KeyedSite& item : keyed) other[place[item.key >> shift & 255]++] = item;
        keyed.swap(other);
    }
}

void LatticeRow::make_runs(const std::vector<KeyedSite>& keyed) {
    for (std::uint32_t n = 0; n < keyed.size(); ++n) {
        if (n > 0 && keyed[n].key >> kPlaceBit == keyed[n - 1].key >> kPlaceBit) continue;
        const auto place = static_cast<std::int32_t>(keyed[n].key >> kPlaceBit & kMostPlaces);
        keys.push_back(run_key(static_cast<std::uint32_t>(keyed[n].key >> kInterfaceBit), place));
        runs.push_back({n});
    }
    keys.push_back(~std::uint64_t{0});
    runs.push_back({static_cast<std::uint32_t>(keyed.size())});
}

/// One sample for the sites of a run that have the same key.
void LatticeRow::make_samples(const LatticeSites& of, const LatticeBlocks& blocks,
                              const std::vector<KeyedSite>& keyed) {
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
        runs[r].samples = static_cast<std::uint32_t>(samples.size());
        const std::uint32_t end = runs[r + 1].site;
        const LatticePoint corner = blocks.corner_of_block(of[sites[runs[r].site]].centroid);
        LatticeRun& run = runs[r];
        run.low.fill(~0);
        const auto note = [&](const LatticePoint& p) {
            for (int axis = 0; axis < 3; ++axis) {
                run.low[axis] = std::min(run.low[axis], blocks.units_below(p, corner, axis));
                run.high[axis] = std::max(run.high[axis], blocks.units_above(p, corner, axis));
            }
        };
        int lane = 4;
        for (std::uint32_t first = runs[r].site, next; first < end; first = next) {
            const LatticeSite& site = of[sites[first]];
            Float3 offset, normal = site.normal;
            note(site.centroid);
            for (next = first + 1; next < end && keyed[next].key == keyed[first].key; ++next) {
                const LatticeSite& other = of[sites[next]];
                offset += blocks.steps.between(site.centroid, other.centroid);
                normal += other.normal;
                note(other.centroid);
            }
            const auto count = static_cast<float>(next - first);
            if (next > first + 1) normal = unit_vector(normal);
            const LatticePoint at =
                next > first + 1 ? blocks.steps.moved(site.centroid, (1 / count) * offset) : site.centroid;
            if (lane == 4) {
                samples.emplace_back();
                lane = 0;
            }
            LatticeSamples& four = samples.back();
            const float normals[3] = {normal.x, normal.y, normal.z};
            for (int axis = 0; axis < 3; ++axis) {
                four.at[axis][lane] = blocks.in_units(at, corner, axis);
                four.normal[axis][lane] = in_normal_units(normals[axis]);
            }
            four.count[lane] = static_cast<std::uint16_t>(next - first);
            four.kind[lane] = site.kind();
            ++lane;
        }
    }
    runs.back().samples = static_cast<std::uint32_t>(samples.size());
}

void LatticeRow::place_fits(const LatticeSites& of, const LatticeBlocks& blocks) {
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
        runs[r].fit = static_cast<std::uint32_t>(fits.size());
        const LatticePoint corner = blocks.corner_of_block(of[sites[runs[r].site]].centroid);
        const std::span own(samples.data() + runs[r].samples, samples.data() + runs[r + 1].samples);
        for (const Group& group : groups_of(own)) {
            const Float3 centre = blocks.from_units(own[0].position_of(0) + (1 / group.count) * group.position);
            fits.emplace_back().quadric.centre = blocks.steps.moved(corner, centre);
            fits.back().quadric.normal = fits.back().quadric.gradient = unit_vector(group.normal);
        }
    }
    runs.back().fit = static_cast<std::uint32_t>(fits.size());
}

std::size_t LatticeRow::bytes() const {
    return (sites.capacity() + wanted.capacity()) * sizeof(std::uint32_t) +
           runs.capacity() * (sizeof(std::uint64_t) + sizeof(LatticeRun)) +
           samples.capacity() * sizeof(LatticeSamples) + fits.capacity() * sizeof(LatticeFit);
}

namespace {

/// std::lower_bound without a branch for each comparison. The last key is not before `key`.
const std::uint64_t* not_before(std::uint64_t key, const std::uint64_t* at, const std::uint64_t* end) {
    for (std::size_t size = end - at; size > 1;) {
        const std::size_t half = size / 2;
        at += at[half - 1] < key ? half : 0;
        size -= half;
    }
    return at;
}

}  // namespace

NearRuns::NearRuns(const std::array<std::vector<LatticeRow>*, 2 * kRings + 1>& layers, std::int32_t number,
                   const LatticeBlocks& blocks)
    : place_axis_(blocks.place_axis) {
    for (int l = -kRings; l <= kRings; ++l) {
        if (!layers[l + kRings]) continue;
        std::vector<LatticeRow>& rows = *layers[l + kRings];
        const auto end = std::min(static_cast<std::int32_t>(rows.size()), number + kRings + 1);
        for (std::int32_t r = std::max(0, number - kRings); r < end; ++r) {
            if (rows[r].runs.empty()) continue;
            Near near{&rows[r], rows[r].keys.data(), {}};
            near.offset[blocks.layer_axis] = static_cast<std::int8_t>(l);
            near.offset[blocks.row_axis] = static_cast<std::int8_t>(r - number);
            rows_.push_back(near);
        }
    }
    near_.resize(rows_.size() * (2 * kRings + 1));
}

std::span<const NearRun> NearRuns::of(std::uint64_t key) {
    NearRun* end = near_.data();
    const auto interface = static_cast<std::uint32_t>(key >> 32);
    const bool is_other = interface != interface_;
    const std::uint64_t first = key - kRings, last = key + kRings;
    for (Near& near : rows_) {
        const std::vector<std::uint64_t>& keys = near.row->keys;
        const std::uint64_t* at = near.next;
        if (is_other)
            at = not_before(first, at, keys.data() + keys.size());
        else
            while (*at < first) ++at;
        near.next = at;
        for (; *at <= last; ++at) {
            end->row = near.row;
            end->run = static_cast<std::uint32_t>(at - keys.data());
            end->offset = near.offset;
            end->offset[place_axis_] = static_cast<std::int8_t>(static_cast<std::int64_t>(*at - key));
            ++end;
        }
    }
    interface_ = interface;
    return {near_.data(), end};
}

}  // namespace regionmesh
