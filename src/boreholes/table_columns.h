// The roles of the columns of a table.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/csv_rows.h"

namespace regionmesh::formats {

/// The role of a column; TetrahedraOptions::columns uses these names.
enum class Role { kX, kY, kZ, kLabel, kName, kTop, kBottom, kSurface, kHole };
inline constexpr std::array kRoleNames{"x", "y", "z", "label", "name", "top", "bottom", "surface", "hole"};

/// A table has x, y, label, and either z or both top and bottom; the others are optional.
struct TableColumns {
    std::array<std::optional<std::size_t>, kRoleNames.size()> places;  // column of each role, counted from 0
    std::vector<std::string> titles;                                   // names of columns in messages: 'x', 5
    std::size_t least_fields = 0;                                      // least number of fields that a row must have
    bool has_header = true;
    bool leaves_intervals = false;  // a table of points that has a top and a bottom, too

    bool has(Role role) const { return places[static_cast<std::size_t>(role)].has_value(); }
    std::size_t of(Role role) const { return *places[static_cast<std::size_t>(role)]; }
    bool are_intervals() const { return !has(Role::kZ); }
};

/// The unit of length that titles of columns name, "x (m)" or "from_ft": one in all tables of a model.
class TitleUnit {
public:
    /// Requires `rows` at the header. Throws Error(kInput) where the title names another unit than one before.
    void add(const CsvRows& rows, std::string_view title);

    /// The metres of the unit; none where no title has named one.
    const std::optional<double>& metres() const { return metres_; }

private:
    std::optional<double> metres_ = {};
    std::string where_ = {};  // "'x (m)' in holes.csv"
};

/// The title without units, blanks and case: "X_m", "x (m)" and "X [m]" are x, "Depth from" is depthfrom.
std::string plain_column_title(std::string_view title);

/// Requires `rows` at the first row. `wanted` is TetrahedraOptions::columns: four columns "x,y,z,label" by name or
/// number from 1, or pairs "x=east,label=3"; other columns are found by their usual names. It is a table of intervals
/// where `wanted` has a top, bottom or surface, or where the header has both and no column z. It has no header where
/// `wanted` gives x and y by number and the first row has numbers there. With `has_collars` another table has x, y and
/// the surface: rows have hole, top, bottom and label, and neither. Adds the titles of lengths to `unit`. Throws
/// Error(kInput) that names the missing column, and Error(kUsage) where `wanted` contradicts itself.
TableColumns find_columns(const CsvRows& rows, const std::string& wanted, bool has_collars, TitleUnit& unit);

}  // namespace regionmesh::formats
