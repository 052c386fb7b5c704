#include "formats/array/array_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/add_warning.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

/// Names of axes that are none of space.
constexpr std::array<std::string_view, 5> kNoPlaces{"c", "channel", "t", "time", "component"};

std::string shape_text(const std::vector<std::uint64_t>& shape) {
    std::string text;
    for (const std::uint64_t size : shape) text += (text.empty() ? "" : " x ") + std::to_string(size);
    return text;
}

/// The axes without names that remain of more than three.
std::vector<int> drop_single(const std::vector<std::uint64_t>& shape) {
    std::vector<int> kept;
    for (int axis = 0; axis < static_cast<int>(shape.size()); ++axis) kept.push_back(axis);
    while (kept.size() > 3 && shape[kept.back()] == 1) kept.pop_back();
    while (kept.size() > 3 && shape[kept.front()] == 1) kept.erase(kept.begin());
    while (kept.size() > 3) {
        const auto single = std::find_if(kept.begin(), kept.end(), [&](int axis) { return shape[axis] == 1; });
        if (single == kept.end()) break;
        kept.erase(single);
    }
    return kept;
}

/// Of four axes without names, that which is not in space: the last if it is one of channels, else the first.
int outer_axis(const std::vector<int>& kept, const std::vector<std::uint64_t>& shape) {
    const std::uint64_t last = shape[kept.back()];
    const bool is_shortest = std::all_of(kept.begin(), kept.end() - 1, [&](int axis) { return last < shape[axis]; });
    return is_shortest ? kept.back() : kept.front();
}

ArrayAxes unnamed_axes(const std::filesystem::path& source, const std::vector<std::uint64_t>& shape) {
    std::vector<int> kept = drop_single(shape);
    if (kept.size() == 4) std::erase(kept, outer_axis(kept, shape));
    if (kept.size() < 2 || kept.size() > 3) {
        fail(source, "the array has " + std::to_string(shape.size()) + " dimensions (" + shape_text(shape) +
                         ") without names for them; save one of shape (z, y, x), or (channel, z, y, x)");
    }
    ArrayAxes axes;
    for (std::size_t i = 0; i < kept.size(); ++i) axes.axis[i] = kept[kept.size() - 1 - i];
    return axes;
}

/// Axes without a name beside others that have one are those that are left of x, y and z, the fastest first. If x or y
/// is still missing, axes with other names take their place.
ArrayAxes named_axes(const std::vector<std::string>& names) {
    ArrayAxes axes;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::size_t known = std::string("xyz").find(lower(names[i]));
        if (names[i].size() == 1 && known != std::string::npos) axes.axis[known] = static_cast<int>(i);
    }
    if (std::ranges::all_of(axes.axis, [](int axis) { return axis < 0; })) return axes;
    const auto fill = [&](auto&& may_stand) {
        for (std::size_t i = names.size(); i-- > 0;) {
            const auto free = std::ranges::find(axes.axis, -1);
            const bool is_taken = std::ranges::count(axes.axis, static_cast<int>(i)) > 0;
            if (free != axes.axis.end() && !is_taken && may_stand(lower(names[i]))) *free = static_cast<int>(i);
        }
    };
    fill([](const std::string& name) { return name.empty(); });
    fill([&](const std::string& name) {
        const bool is_missing = axes.axis[0] < 0 || axes.axis[1] < 0;
        return is_missing && std::ranges::find(kNoPlaces, name) == kNoPlaces.end();
    });
    return axes;
}

}  // namespace

std::array<std::uint64_t, 3> ArrayAxes::along(const std::vector<std::uint64_t>& numbers,
                                              std::uint64_t otherwise) const {
    std::array<std::uint64_t, 3> chosen{};
    for (int i = 0; i < 3; ++i) chosen[i] = axis[i] < 0 ? otherwise : numbers[axis[i]];
    return chosen;
}

ReadOptions ArrayAxes::without_layer(const ReadOptions& options) const {
    ReadOptions rest = options;
    if (!has_layers) return rest;
    rest.layer.reset();
    return rest;
}

ArrayAxes choose_axes(const std::filesystem::path& source, const std::vector<std::uint64_t>& shape,
                      const std::vector<std::string>& names, const ReadOptions& options) {
    ArrayAxes axes;
    if (names.size() == shape.size()) axes = named_axes(names);
    const bool is_named = axes.axis[0] >= 0 && axes.axis[1] >= 0;
    if (!is_named) axes = unnamed_axes(source, shape);
    axes.index.assign(shape.size(), 0);
    for (std::size_t i = 0; i < shape.size(); ++i) {
        if (std::ranges::count(axes.axis, static_cast<int>(i)) > 0 || shape[i] == 1) continue;
        const std::string what =
            (i >= names.size() || names[i].empty() ? "axis " + std::to_string(i) : "axis '" + names[i] + "'") +
            " has " + std::to_string(shape[i]) + " samples";
        if (shape[i] == 0) fail(source, what + "; give a volume that has some");
        if (axes.has_layers) fail(source, what + "; another axis has more than one, too: save one volume");
        if (!options.layer) fail(source, what + "; choose one with --layer 0 to " + std::to_string(shape[i] - 1));
        if (*options.layer >= shape[i]) fail(source, what + "; there is no " + std::to_string(*options.layer));
        axes.index[i] = *options.layer;
        axes.has_layers = true;
        axes.layer_count = shape[i];
    }
    return axes;
}

bool may_be_volume(const std::vector<std::uint64_t>& shape) {
    const auto more = std::ranges::count_if(shape, [](std::uint64_t size) { return size > 1; });
    return std::ranges::count(shape, 0u) == 0 && (more == 2 || more == 3);
}

void place(VolumeInfo& info, const Placement& placement, const ReadOptions& options) {
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = placement.spacing[axis];
        if (!options.spacing && (!std::isfinite(spacing) || spacing == 0)) {
            fail(info.source,
                 fmt::format("spacing along {} is {:g} in the file; give the right one with --spacing X,Y,Z",
                             "xyz"[axis], spacing));
        }
        const double sign = spacing < 0 ? -1 : 1;
        const double used = options.spacing ? sign * (*options.spacing)[axis] : spacing;
        const double origin = placement.origin[axis] + placement.steps[axis] * used;
        if (!std::isfinite(origin)) {
            fail(info.source, std::string("the position of the first sample along ") + "xyz"[axis] + " is " +
                                  std::to_string(origin) + "; mend the file");
        }
        info.lattice.spacing[axis] = std::abs(spacing);
        info.lattice.origin[axis] = origin;
        info.lattice.direction[axis * 4] = sign;
    }
    info.metres = placement.metres;
    info.warning = placement.warning;
}

Placement common_placement(const ArrayAxes& axes, std::size_t axis_count, const ReadOptions& options,
                           const FindNumbers& find) {
    Placement placement;
    const auto take = [&](const char* name, std::array<double, 3>& target) {
        const auto numbers = find(name);
        if (!numbers) return false;
        const bool is_whole = numbers->size() == axis_count;
        if (!is_whole && numbers->size() != 3) {
            add_warning(placement.warning, fmt::format("the attribute '{}' is not used: 3 numbers are needed, not {}",
                                                       name, numbers->size()));
            return false;
        }
        for (int i = 0; i < 3; ++i) {
            if (is_whole && axes.axis[i] >= 0) target[i] = (*numbers)[axes.axis[i]];
            // Three numbers: in the order of x, y and z in the array; one that it lacks is z, and comes first.
            if (!is_whole)
                target[i] = (*numbers)[std::ranges::count_if(axes.axis, [&](int a) { return a < axes.axis[i]; })];
        }
        return true;
    };
    if (take("element_size_um", placement.spacing))
        placement.metres = 1e-6;
    else
        for (const char* name : {"voxel_size", "resolution", "spacing"})
            if (take(name, placement.spacing)) break;
    if (options.spacing) placement.warning.clear();
    for (const char* name : {"offset", "origin", "translation"}) {
        if (take(name, placement.origin)) break;
    }
    return placement;
}

}  // namespace regionmesh::formats
