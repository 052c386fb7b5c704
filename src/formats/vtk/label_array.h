// Which array of a mesh says the labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace regionmesh::formats {

/// An array of a mesh, as its header tells of it.
struct MeshArray {
    std::string name;
    bool is_cell = true;  // one value a cell, else a point
    bool is_integer = true;
    std::string type = {};  // for messages
    std::uint64_t components = 1;
};

/// Names that usually mean regions, the most telling one first: the place of this one among them; none for others.
std::optional<std::size_t> region_rank(std::string_view name);

/// The array called `wanted`, cells before points. Where that is empty: the only one of integers that is no number of a
/// node or the like; else the one whose name says most that it means regions, which may have reals. Arrays of several
/// components never count. Throws Error(kInput) that lists what there is.
std::size_t choose_label_array(const std::filesystem::path& path, std::span<const MeshArray> arrays,
                               const std::string& wanted);

/// "label (cells, Int32); u (points, Float64, 3 components)", of the first twenty.
std::string list_of(std::span<const MeshArray> arrays);

/// A real as the integer it is; none for others, and from 2^53 on.
std::optional<std::int64_t> whole_number(double real);

}  // namespace regionmesh::formats
