#include "smooth/lattice_row.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace regionmesh {
namespace {

/// Groups of sites in a block are one sheet above this cosine.
constexpr float kJoins = 0.7f;

/// Samples of a block that face about the same way.
struct Group {
    Float3 position, normal;  // sums
    float count;
    std::uint8_t direction;
};

/// By direction; a group that faces about the same way as a larger one joins it. Positions are sums of offsets from the
/// first sample.
std::vector<Group>& groups_of(const LatticeSamples& samples, std::uint32_t first, std::uint32_t end) {
    thread_local std::vector<Group> groups, joined;
    groups.clear();
    for (std::uint32_t n = first; n < end; ++n) {
        const Float3 normal = samples.normal_of(n);
        const std::uint8_t direction = direction_of(normal);
        auto group =
            std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.direction == direction; });
        if (group == groups.end()) group = groups.insert(group, {{}, {}, 0, direction});
        group->position += samples.count[n] * (samples.position(n) - samples.position(first));
        group->normal += samples.count[n] * normal;
        group->count += samples.count[n];
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
    : layer_axis(sweep_axis), row_axis((sweep_axis + 2) % 3), place_axis((sweep_axis + 1) % 3) {
    spacing = Float3(frame.spacing / frame.finest());
    const auto least = static_cast<float>(block_size);
    size = {std::max(least, spacing.x), std::max(least, spacing.y), std::max(least, spacing.z)};
    per_size = {1 / size.x, 1 / size.y, 1 / size.z};
}

/// The small shift keeps centroids on a plane between cells on one side of it, whatever their rounding. Coordinates are
/// not negative, so that truncation is the floor.
std::int64_t LatticeBlocks::cell_of(double coordinate, int axis) const {
    return static_cast<std::int64_t>(coordinate / size_along(axis) * kCells + 1e-4);
}

void LatticeSamples::push_back(const LatticePoint& position, Float3 unit_normal, float site_count, int kind_) {
    const float along[3] = {unit_normal.x, unit_normal.y, unit_normal.z};
    for (int axis = 0; axis < 3; ++axis) {
        at[axis].push_back(position.at[axis]);
        normal[axis].push_back(along[axis]);
    }
    count.push_back(site_count);
    kind.push_back(static_cast<std::uint8_t>(kind_));
}

void LatticeSamples::end() {
    for (int n = 0; n < 3; ++n) push_back({}, {}, 0, 1);
    for (int axis = 0; axis < 3; ++axis) {
        at[axis].shrink_to_fit();
        normal[axis].shrink_to_fit();
    }
    count.shrink_to_fit();
    kind.shrink_to_fit();
}

void LatticeRow::sort(const LatticeSites& of, const LatticeBlocks& blocks) {
    struct Entry {
        std::uint64_t run, rest;  // interface and block; direction, cell in the block, kind
        std::uint32_t site;
        bool operator<(const Entry& other) const {
            return std::tie(run, rest, site) < std::tie(other.run, other.rest, other.site);
        }
    };
    constexpr std::uint64_t kCells = LatticeBlocks::kCells;
    thread_local std::vector<Entry> entries;
    entries.clear();
    for (std::uint32_t s : sites) {
        const LatticeSite& site = of[s];
        const auto cell = [&](int axis) { return static_cast<std::uint64_t>(blocks.cell_of(site.centroid, axis)); };
        const std::uint64_t along = cell(blocks.place_axis);
        std::uint64_t rest = direction_of(site.normal);
        rest = rest * kCells + cell(blocks.layer_axis) % kCells;
        rest = rest * kCells + cell(blocks.row_axis) % kCells;
        rest = rest * kCells + along % kCells;
        entries.push_back(
            {static_cast<std::uint64_t>(site.interface) << 32 | along / kCells, rest * kKindCount + site.kind, s});
    }
    std::sort(entries.begin(), entries.end());
    std::vector<std::uint64_t> keys;
    keys.reserve(entries.size());
    for (std::uint32_t n = 0; n < entries.size(); ++n) {
        const std::uint64_t run = entries[n].run;
        if (n == 0 || run != entries[n - 1].run)
            runs.push_back({static_cast<std::uint32_t>(run >> 32), static_cast<std::int32_t>(run), n, 0, 0});
        sites[n] = entries[n].site;
        keys.push_back(entries[n].rest);
    }
    constexpr auto kLast = std::numeric_limits<std::int32_t>::max();
    runs.push_back({~0u, kLast, static_cast<std::uint32_t>(entries.size()), 0, 0});
    make_samples(of, keys);
    place_fits();
    sites.shrink_to_fit();
    runs.shrink_to_fit();
    fits.shrink_to_fit();
    samples.end();
}

/// One sample for the sites of a run that have the same key.
void LatticeRow::make_samples(const LatticeSites& of, const std::vector<std::uint64_t>& keys) {
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
        runs[r].sample = samples.size();
        const std::uint32_t end = runs[r + 1].site;
        for (std::uint32_t first = runs[r].site, next; first < end; first = next) {
            const LatticeSite& site = of[sites[first]];
            next = first + 1;
            if (next == end || keys[next] != keys[first]) {
                samples.push_back(site.centroid, site.normal, 1, site.kind);
                continue;
            }
            Float3 offset, normal = site.normal;
            for (; next < end && keys[next] == keys[first]; ++next) {
                const LatticeSite& other = of[sites[next]];
                offset += other.centroid - site.centroid;
                normal += other.normal;
            }
            const auto count = static_cast<float>(next - first);
            samples.push_back(site.centroid + (1 / count) * offset, (1 / length(normal)) * normal, count, site.kind);
        }
    }
    runs.back().sample = samples.size();
}

void LatticeRow::place_fits() {
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
        runs[r].fit = static_cast<std::uint32_t>(fits.size());
        for (const Group& group : groups_of(samples, runs[r].sample, runs[r + 1].sample)) {
            const LatticePoint centre = samples.position(runs[r].sample) + (1 / group.count) * group.position;
            fits.emplace_back().quadric.centre = centre;
            fits.back().quadric.normal = (1 / length(group.normal)) * group.normal;
        }
    }
    runs.back().fit = static_cast<std::uint32_t>(fits.size());
}

std::size_t LatticeRow::bytes() const {
    return (sites.capacity() + wanted.capacity()) * sizeof(std::uint32_t) + runs.capacity() * sizeof(LatticeRun) +
           samples.bytes() + fits.capacity() * sizeof(LatticeFit);
}

NearRuns::NearRuns(const std::array<std::vector<LatticeRow>*, 2 * kRings + 1>& layers, std::int32_t number,
                   const LatticeBlocks& blocks)
    : place_axis_(blocks.place_axis) {
    for (int l = -kRings; l <= kRings; ++l) {
        if (!layers[l + kRings]) continue;
        std::vector<LatticeRow>& rows = *layers[l + kRings];
        const auto end = std::min(static_cast<std::int32_t>(rows.size()), number + kRings + 1);
        for (std::int32_t r = std::max(0, number - kRings); r < end; ++r) {
            if (rows[r].runs.empty()) continue;
            Near near{&rows[r], 0, {}};
            near.offset[blocks.layer_axis] = static_cast<std::int8_t>(l);
            near.offset[blocks.row_axis] = static_cast<std::int8_t>(r - number);
            rows_.push_back(near);
        }
    }
}

const std::vector<NearRun>& NearRuns::of(const LatticeRun& run) {
    near_.clear();
    for (Near& near : rows_) {
        const std::vector<LatticeRun>& runs = near.row->runs;
        const LatticeRun first{run.interface, run.place - kRings, 0, 0, 0};
        if (interface_ != run.interface)
            near.next = static_cast<std::uint32_t>(std::lower_bound(runs.begin() + near.next, runs.end(), first) -
                                                   runs.begin());
        while (runs[near.next] < first) ++near.next;
        for (std::uint32_t n = near.next; runs[n].interface == run.interface && runs[n].place <= run.place + kRings;
             ++n) {
            near_.push_back({near.row, n, near.offset});
            near_.back().offset[place_axis_] = static_cast<std::int8_t>(runs[n].place - run.place);
        }
    }
    interface_ = run.interface;
    return near_;
}

}  // namespace regionmesh
