// Which column of a table is what.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "formats/text/csv_rows.h"

namespace regionmesh::formats {

/// What a column may hold; TetrahedraOptions::columns calls them by these names.
enum class Role { kX, kY, kZ, kLabel, kName, kTop, kBottom, kSurface, kHole };
inline constexpr std::array kRoleNames{"x", "y", "z", "label", "name", "top", "bottom", "surface", "hole"};

/// A table has x, y, label, and z or else both top and bottom; the others are there or not.
struct TableColumns {
    std::array<std::optional<std::size_t>, kRoleNames.size()> places;  // from 0
    std::vector<std::string> titles;                                   // as an error shows them: 'x', 5
    std::size_t least_fields = 0;                                      // a row must have
    bool has_header = true;

    bool has(Role role) const { return places[static_cast<std::size_t>(role)].has_value(); }
    std::size_t of(Role role) const { return *places[static_cast<std::size_t>(role)]; }
    bool are_intervals() const { return !has(Role::kZ); }
};

/// `rows` stands on the first row. `wanted` is TetrahedraOptions::columns: "x,y,z,label" as names or numbers from 1, or
/// pairs "x=east,label=3"; what it leaves open is found by the names that columns usually have. A table is one of
/// intervals where `wanted` has a top or bottom, or the header has both and no column z. It has no header where
/// `wanted` gives x and y by number and numbers stand there. Throws Error(kInput) saying which column is missing.
TableColumns find_columns(const CsvRows& rows, const std::string& wanted);

}  // namespace regionmesh::formats
