// Selects the array of a mesh that has the labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace regionmesh::formats {

/// The description of an array in the header of a mesh.
struct MeshArray {
    std::string name;
    bool is_cell = true;  // one value per cell, otherwise per point
    bool is_integer = true;
    std::string type = {};  // for messages
    std::uint64_t components = 1;
};

/// The rank of a name among those that usually mean regions, the most specific first; none for other names.
std::optional<std::size_t> region_rank(std::string_view name);

/// The array named `wanted`, that of cells before that of points. Where `wanted` is empty: the array with the best
/// region_rank, integers before reals; otherwise the only array of integers that is no numbering of nodes or cells.
/// Never an array of several components. Throws Error(kInput) that lists the arrays.
std::size_t choose_label_array(const std::filesystem::path& path, std::span<const MeshArray> arrays,
                               const std::string& wanted);

/// "label (cells, Int32); u (points, Float64, 3 components)", for the first twenty arrays.
std::string list_of(std::span<const MeshArray> arrays);

/// A whole real as an integer; none for other reals, and from 2^53 on.
std::optional<std::int64_t> whole_number(double real);

}  // namespace regionmesh::formats
