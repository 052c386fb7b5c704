#include "formats/vtk/label_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::array<std::string_view, 11> kRegionNames{"label",         "labels",      "region",          "region_id",
                                                        "material",      "materialids", "gmsh:physical",   "medit:ref",
                                                        "cellentityids", "featureids",  "gmsh:geometrical"};

/// Names of arrays that number nodes or cells, or mark ghosts.
constexpr std::array<std::string_view, 11> kOtherNames{
    "globalids", "globalnodeids", "globalelementids", "pedigreeids", "vtkoriginalcellids", "vtkoriginalpointids",
    "nodeids",   "elementids",    "cellids",          "pointids",    "gmsh:dim_tags"};

bool is_of_other_use(const std::string& name) {
    return name.starts_with("vtkghost") || std::find(kOtherNames.begin(), kOtherNames.end(), name) != kOtherNames.end();
}

std::string text_of(const MeshArray& array) {
    return fmt::format("{} ({}, {}{})", shown(array.name), array.is_cell ? "cells" : "points", shown(array.type),
                       array.components == 1 ? "" : fmt::format(", {} components", array.components));
}

}  // namespace

std::optional<std::size_t> region_rank(std::string_view name) {
    const auto found = std::find(kRegionNames.begin(), kRegionNames.end(), lower(name));
    if (found == kRegionNames.end()) return std::nullopt;
    return static_cast<std::size_t>(found - kRegionNames.begin());
}

std::optional<std::int64_t> whole_number(double real) {
    constexpr double kLimit = 9007199254740992;  // 2^53
    if (!(std::abs(real) < kLimit) || std::trunc(real) != real) return std::nullopt;
    return static_cast<std::int64_t>(real);
}

std::string list_of(std::span<const MeshArray> arrays) {
    constexpr std::size_t kShown = 20;
    std::string names;
    for (const MeshArray& array : arrays.first(std::min(arrays.size(), kShown)))
        names += (names.empty() ? "" : "; ") + text_of(array);
    if (arrays.size() > kShown) names += fmt::format("; and {} more", arrays.size() - kShown);
    return names.empty() ? "none" : names;
}

std::size_t choose_label_array(const std::filesystem::path& path, std::span<const MeshArray> arrays,
                               const std::string& wanted) {
    std::vector<std::size_t> integers;
    std::optional<std::size_t> best;
    const auto better = [&](std::size_t i) {  // integers before reals, then by name, cells before points
        const auto key = [&](std::size_t n) {
            return std::tuple(!arrays[n].is_integer, *region_rank(arrays[n].name), !arrays[n].is_cell);
        };
        return region_rank(arrays[i].name) && (!best || key(i) < key(*best));
    };
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        if (!wanted.empty()) {
            if (arrays[i].name == wanted && (!best || arrays[i].is_cell > arrays[*best].is_cell)) best = i;
        } else if (arrays[i].components == 1 && !is_of_other_use(lower(arrays[i].name))) {
            if (arrays[i].is_integer) integers.push_back(i);
            if (better(i)) best = i;
        }
    }
    if (!wanted.empty()) {
        if (!best) fail(path, fmt::format("has no array '{}'; its arrays: {}", shown(wanted), list_of(arrays)));
        if (arrays[*best].components != 1)
            fail(path, fmt::format("array '{}' has {} components; labels are single numbers; its arrays: {}",
                                   shown(wanted), arrays[*best].components, list_of(arrays)));
        return *best;
    }
    if (best) return *best;
    if (integers.size() == 1) return integers[0];
    fail(path, fmt::format("{}; say which with --array NAME; its arrays: {}",
                           integers.empty() ? "has no array of integers that could be labels"
                                            : "has several arrays of integers, and no name that means regions",
                           list_of(arrays)));
}

}  // namespace regionmesh::formats
