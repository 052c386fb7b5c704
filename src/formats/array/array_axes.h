// Chooses the axes of a stored array that are x, y and z, and reads spacing and origin from its attributes.
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
    std::array<int, 3> axis{-1, -1, -1};  // the axes of the array that are x, y and z; -1: none, with one sample
    std::vector<std::uint64_t> index;     // of the volume along the other axes
    bool has_layers = false;              // the options chose one of these indices,
    std::uint64_t layer_count = 1;        // of as many

    /// The options without those that were used to choose an index.
    ReadOptions without_layer(const ReadOptions& options) const;

    /// Of a number for each axis of the array, those along x, y, z; `otherwise` where there is no such axis.
    std::array<std::uint64_t, 3> along(const std::vector<std::uint64_t>& numbers, std::uint64_t otherwise = 1) const;
};

/// Axes named x, y and z are those; others are channels, times and the like, or what is missing of x and y. Without
/// names the last three axes are z, y, x; if there are more than three, axes of one sample are dropped: at the end,
/// then at the start, then between; if there are still four, the last is one of channels if it has fewer samples than
/// all others, else the first is one of volumes. An axis other than x, y, z with more than one sample needs
/// options.layer; two are refused. Errors name the axis.
ArrayAxes choose_axes(const std::filesystem::path& source, const std::vector<std::uint64_t>& shape,
                      const std::vector<std::string>& names, const ReadOptions& options);

/// Whether two or three axes have more than one sample, and none has no sample.
bool may_be_volume(const std::vector<std::uint64_t>& shape);

/// Along x, y, z: the spacing, and the first sample, `steps` spacings from `origin`.
struct Placement {
    std::array<double, 3> spacing{1, 1, 1};
    std::array<double, 3> origin{0, 0, 0};
    std::array<double, 3> steps{0, 0, 0};
    std::optional<double> metres = {};  // in the unit of these numbers
    std::string warning = {};           // as VolumeInfo has it
};

/// Sets the lattice of `info`, and its warning. A negative spacing mirrors the axis. Throws if a number is not finite
/// or a spacing is 0, unless the options give the spacing.
void place(VolumeInfo& info, const Placement& placement, const ReadOptions& options);

/// The numbers of an attribute: an empty list if it holds anything else, nullopt if there is no such attribute.
using FindNumbers = std::function<std::optional<std::vector<double>>(const std::string& name)>;

/// Reads attributes in common use, along the axes of the array (mostly z, y, x): the spacing is the first of
/// `element_size_um`, `voxel_size`, `resolution` and `spacing`, the first sample is the first of `offset`, `origin` and
/// `translation`. A list is used if it has a number for each axis, or three: for x, y and z in their order in the
/// array; a warning names what is not used for that reason, unless the options replace it.
Placement common_placement(const ArrayAxes& axes, std::size_t axis_count, const ReadOptions& options,
                           const FindNumbers& find);

}  // namespace regionmesh::formats
