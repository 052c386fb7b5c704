// Sections of a model of layers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/add_warning.h"
#include "base/megabytes.h"
#include "boreholes/layer_order.h"
#include "boreholes/layer_surfaces.h"
#include "boreholes/point_table.h"
#include "formats/input_file.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"
#include "regionmesh/limits.h"
#include "volume/choose_sweep.h"

namespace regionmesh::formats {
namespace {

constexpr double kGoodOrder = 0.9;  // share of the logged length; below it is worth a warning
constexpr double kColumnsOfSide = 100, kSamplesOfHeight = 200;  // numbers of samples where no spacing is given
constexpr double kMostHeightBytes = 4e9, kMostSamplesOfAxis = 1e6, kMostNumber = 1e18;
constexpr double kSolve = 1.0 / 64;  // time to solve for the weights, in evaluations per cube of the holes
constexpr double kMargin = 0.5;      // share of the mean distance from a hole to the next
constexpr double kRounding = 1e-9;   // share of a number of steps

class LayerSections final : public SectionReader {
public:
    LayerSections(VolumeInfo info, LayerSurfaces surfaces, std::vector<InputLabel> labels)
        : info_(std::move(info)), surfaces_(std::move(surfaces)), labels_(std::move(labels)) {}

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        if (section_ == section_count()) return false;
        const auto& [u, v, w] = info_.sweep.axes;
        std::array<std::uint32_t, 3> at{};
        at[static_cast<std::size_t>(w)] = section_++;
        for (std::size_t n = 0; n < section.size(); ++n) {
            at[static_cast<std::size_t>(u)] = static_cast<std::uint32_t>(n % section_width());
            at[static_cast<std::size_t>(v)] = static_cast<std::uint32_t>(n / section_width());
            section[n] = label_at(at);
        }
        return true;
    }

    void rewind() override { section_ = 0; }

private:
    InputLabel label_at(const std::array<std::uint32_t, 3>& at) const {
        const Lattice& lattice = info_.lattice;
        const double z = lattice.origin.z + at[2] * lattice.spacing.z;
        return labels_[surfaces_.layer_of(std::size_t{at[1]} * lattice.size[0] + at[0], z)];
    }

    VolumeInfo info_;
    LayerSurfaces surfaces_;
    std::vector<InputLabel> labels_;  // labels of the air, then of the units from young to old
    std::uint32_t section_ = 0;
};

/// The box and the spacing of the samples.
class LatticeFinder {
public:
    LatticeFinder(const HoleTable& table, const LayerOptions& options) : table_(table), options_(options) {
        for (const HeightSample& collar : table.holes.collars) {
            low_ = min(low_, {collar.x, collar.y, collar.z});
            high_ = max(high_, {collar.x, collar.y, collar.z});
        }
        for (const Interval& interval : table.holes.intervals) {
            const Vec3 end{interval.bottom_x, interval.bottom_y, interval.bottom};
            low_ = min(low_, end);
            high_ = max(high_, end);
        }
    }

    /// The lattice with all of the ground in it, where --box leaves the top open: `ground` is its highest height.
    Lattice find(double ground = -INFINITY) const {
        const double margin = kMargin * mean_distance(table_.holes.collars);
        std::array<double, 3> low{low_.x - margin, low_.y - margin, low_.z},
            high{high_.x + margin, high_.y + margin, std::max(high_.z, ground)};
        high[2] += (high[2] - low[2]) / kSamplesOfHeight;  // above the ground
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const LengthRange& range = options_.box[axis];
            if (std::isfinite(range.low)) low[axis] = range.low;
            if (std::isfinite(range.high)) high[axis] = range.high;
            if (!(low[axis] < high[axis]))
                fail(table_.holes.path,
                     fmt::format("the model has no extent along {}, from {} to {}; give another --box", "xyz"[axis],
                                 low[axis], high[axis]));
        }
        const double side = std::max(high[0] - low[0], high[1] - low[1]) / kColumnsOfSide;
        const Vec3 spacing = options_.spacing.value_or(Vec3{side, side, (high[2] - low[2]) / kSamplesOfHeight});
        Lattice lattice{.spacing = spacing, .origin = {low[0], low[1], low[2]}};
        for (int axis = 0; axis < 3; ++axis) fit(lattice, axis, high[static_cast<std::size_t>(axis)]);
        require_lattice(table_.holes.path.string(), lattice);
        return lattice;
    }

private:
    /// Sets the number of samples along an axis, up to about `high`. Bounds of --box are kept: where it gives both, the
    /// spacing is adjusted to them, where it gives the high one alone, the low one is. An open top lies above `high`.
    void fit(Lattice& lattice, int axis, double high) const {
        const LengthRange& range = options_.box[static_cast<std::size_t>(axis)];
        const bool keeps_low = std::isfinite(range.low), keeps_high = std::isfinite(range.high);
        double& step = lattice.spacing[axis];
        double& low = lattice.origin[axis];
        const double steps = (high - low) / step;
        if (!(step > 0) || !(steps <= kMostSamplesOfAxis))
            fail(table_.holes.path,
                 fmt::format("--spacing {} along {} makes too many samples; give a larger one", step, "xyz"[axis]));
        const bool is_above = !keeps_high && axis == 2;
        const double count = std::max(is_above ? std::ceil(steps - kRounding) : std::round(steps), 1.0);
        if (keeps_low && keeps_high && std::abs(count - steps) > kRounding * steps) step = (high - low) / count;
        if (!keeps_low && keeps_high) low = high - count * step;
        lattice.size[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(count) + 1;
    }

    static Vec3 min(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
    static Vec3 max(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

    const HoleTable& table_;
    const LayerOptions& options_;
    Vec3 low_{INFINITY, INFINITY, INFINITY}, high_{-INFINITY, -INFINITY, -INFINITY};
};

/// The bytes of the heights. Refuses a model that needs more memory or more work than the options allow.
std::uint64_t require_columns(const HoleTable& table, const Lattice& lattice, std::size_t units,
                              const LayerOptions& options) {
    const std::filesystem::path& path = table.holes.path;
    const double columns = static_cast<double>(lattice.size[0]) * lattice.size[1],
                 surfaces = static_cast<double>(units), holes = static_cast<double>(table.holes.collars.size());
    const double bytes = columns * surfaces * sizeof(double);
    const double most = std::min(static_cast<double>(options.memory), kMostHeightBytes);
    if (bytes > most)
        fail(path, fmt::format("{} x {} columns of {} surfaces take {}, more than {}; give a larger --spacing{}",
                               lattice.size[0], lattice.size[1], units,
                               bytes < kMostNumber ? megabytes(static_cast<std::uint64_t>(bytes)) : "too many bytes",
                               bytes > kMostHeightBytes ? "4 GB" : memory_limit_text(options.memory),
                               bytes > kMostHeightBytes ? "" : " or more memory"));
    const double work = columns * lattice.size[2] + columns * surfaces * holes + surfaces * std::pow(holes, 3) * kSolve;
    if (!(work <= static_cast<double>(options.max_work)))
        fail(path,
             fmt::format("{} x {} x {} samples of {} surfaces between {} holes are work of {:.0f}, more than "
                         "--max-work {}; give a larger --spacing, or raise --max-work",
                         lattice.size[0], lattice.size[1], lattice.size[2], units, holes, work, options.max_work));
    return static_cast<std::uint64_t>(bytes);
}

/// Coordinates whose squares are numbers; --box may leave out data that lie farther away.
void require_places(const std::filesystem::path& path, const DrillHoles& holes) {
    Box box;
    for (const Interval& interval : holes.intervals) {
        const Vec3 ends[] = {{interval.x, interval.y, interval.top},
                             {interval.bottom_x, interval.bottom_y, interval.bottom}};
        for (const Vec3& end : ends) {
            if (!is_finite(end))
                fail(path, fmt::format("row {}: its interval ends beyond all numbers; mend the path of its hole",
                                       interval.row));
            box.add(end);
        }
    }
    if (!holes.intervals.empty()) require_extent(path.string(), box);
}

/// A terrain that is nowhere above the model is that of another place, or in other coordinates.
void require_overlap(const Terrain& terrain, const ColumnGrid& grid, const std::filesystem::path& path) {
    for (std::uint32_t j = 0; j < grid.height; ++j)
        for (std::uint32_t i = 0; i < grid.width; ++i)
            if (terrain.at(grid.x + i * grid.dx, grid.y + j * grid.dy)) return;
    fail(path, fmt::format("has no height in the model, which lies at x {} to {} and y {} to {}; give the grid of this "
                           "place",
                           grid.x, grid.x + (grid.width - 1) * grid.dx, grid.y, grid.y + (grid.height - 1) * grid.dy));
}

/// The labels of the air and of the units; sets type, names and warning in `info`. Words get labels by age. Throws
/// Error(kInput) where a unit would have the label of the air, or two the same.
std::vector<InputLabel> labels_of(const TableLabels& labels, const LayerOrder& order, VolumeInfo& info) {
    TetrahedraInfo table;
    const std::vector<InputLabel> all = labels.labels(table);
    std::vector<InputLabel> found{0};
    info.type = table.is_unsigned ? SampleType::kU64 : SampleType::kI64;
    add_warning(info.warning, table.warning);
    for (std::uint32_t n = 0; n < order.units.size(); ++n) {
        const std::uint32_t unit = order.units[n];
        const InputLabel label = labels.are_words() ? InputLabel{n} + 1 : all[unit];
        if (std::find(found.begin(), found.end(), label) != found.end())
            fail(info.source, fmt::format("unit {} {}; give units other numbers, or words", labels.text(unit),
                                          label == 0 ? "has the number 0, which stands for the air"
                                                     : "has the number of another unit"));
        found.push_back(label);
        const auto name = table.names.find(all[unit]);
        if (name != table.names.end()) info.names.emplace(label, name->second);
    }
    return found;
}

}  // namespace

std::unique_ptr<SectionReader> open_layer_sections(const std::filesystem::path& path, const TetrahedraOptions& options,
                                                   const LayerOptions& layers, LayerSummary* summary) {
    const HoleTable table = read_hole_table(path, options);
    if (table.holes.collars.size() > kMostHoles)
        fail(path, fmt::format("has {} holes; --layers takes at most {}, leave some out", table.holes.collars.size(),
                               kMostHoles));
    require_places(path, table.holes);
    const LayerOrder order = order_layers(table.holes, table.labels, layers.units);
    VolumeInfo info{.source = path.string(),
                    .format = "csv",
                    .can_sweep = {true, true, true},
                    .metres = table.metres,
                    .warning = table.warning};
    const LatticeFinder lattices(table, layers);
    const Lattice lattice = lattices.find();  // the columns of this lattice stay
    info.held_bytes = require_columns(table, lattice, order.units.size(), layers);
    std::optional<Terrain> terrain;
    if (!layers.terrain.empty()) terrain.emplace(layers.terrain, layers.memory - info.held_bytes);
    const ColumnGrid grid{lattice.size[0],  lattice.size[1],   lattice.origin.x,
                          lattice.origin.y, lattice.spacing.x, lattice.spacing.y};
    if (terrain) require_overlap(*terrain, grid, layers.terrain);
    const Ground ground(table.holes.collars, terrain ? &*terrain : nullptr, layers.threads);
    std::vector<double> heights = heights_of(ground, grid, layers.threads);
    info.lattice = lattices.find(std::ranges::max(heights));
    require_columns(table, info.lattice, order.units.size(), layers);
    info.sweep = *choose_sweep(info, layers.sweep);
    LayerSurfaces surfaces = interpolate(order, ground, std::move(heights), grid, layers.threads);
    std::vector<InputLabel> labels = labels_of(table.labels, order, info);
    if (order.ordered_share < kGoodOrder)
        add_warning(info.warning, fmt::format("only {:.0f} % of the logged length is in the order of the layers; "
                                              "regionmesh info --layers prints the order",
                                              100 * order.ordered_share));
    if (summary) {
        *summary = {};
        summary->ordered_share = order.ordered_share;
        for (const std::uint32_t unit : order.units) summary->units.push_back(table.labels.text(unit));
    }
    return std::make_unique<LayerSections>(std::move(info), std::move(surfaces), std::move(labels));
}

}  // namespace regionmesh::formats
