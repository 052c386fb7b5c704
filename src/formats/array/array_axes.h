// Which axes of a stored array are x, y and z, and what its attributes say of their place in space.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// A volume within an array of two axes or more.
struct ArrayAxes {
    std::array<int, 3> axis{-1, -1, -1};  // of the array that are x, y and z; -1: none, and one sample along it
    std::vector<std::uint64_t> index;     // along all others
    bool has_layers = false;              // one of them was chosen by options.layer

    /// What is left of the options when the layer is chosen.
    ReadOptions without_layer(const ReadOptions& options) const;

    /// A number for each axis of the array, taken along x, y, z; `otherwise` where there is none.
    std::array<std::uint64_t, 3> along(const std::vector<std::uint64_t>& numbers, std::uint64_t otherwise = 1) const;
};

/// With names (x, y, z; others are channels, times and the like) axes go by them. Without, the last three are z, y, x,
/// and of more than three those of one sample are dropped: behind, then before, then between. Of axes that are none of
/// x, y, z those of one sample are dropped; one of more needs options.layer, two are refused. Throws naming the axis.
ArrayAxes choose_axes(const std::filesystem::path& source, const std::vector<std::uint64_t>& shape,
                      const std::vector<std::string>& names, const ReadOptions& options);

/// Spacing and the place of the first sample, along x, y, z.
struct Placement {
    std::array<double, 3> spacing{1, 1, 1};
    std::array<double, 3> origin{0, 0, 0};
};

/// Gives `info` that place. A negative spacing mirrors the axis. Throws for a spacing of 0, or where a number is not
/// finite, unless the options give the spacing.
void place(VolumeInfo& info, const Placement& placement, const ReadOptions& options);

/// Numbers under a name, or none.
using FindNumbers = std::function<std::vector<double>(const std::string& name)>;

/// What attributes in common use say, along the array's own axes (z, y, x most often): the spacing in
/// `element_size_um`, `voxel_size`, `resolution` or `spacing`, the first of them that is there; the first sample in
/// `offset`, `origin` or `translation`. Lists of another length than the axes are passed over.
Placement common_placement(const ArrayAxes& axes, std::size_t axis_count, const FindNumbers& find);

}  // namespace regionmesh::formats
