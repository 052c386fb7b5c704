#include "boreholes/point_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/add_warning.h"
#include "boreholes/drill_holes.h"
#include "boreholes/hole_paths.h"
#include "boreholes/table_columns.h"
#include "boreholes/table_labels.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/csv_rows.h"
#include "formats/text/header_text.h"
#include "regionmesh/limits.h"
#include "volume/exact_grid.h"

namespace regionmesh::formats {
namespace {

constexpr std::string_view kHull =
    "drill holes become points, and their regions are coarse hulls; with --layers auto the bases of the units are "
    "interpolated between the holes, and --step says that points are wanted";
constexpr std::uint64_t kLeastRowBytes = 8;  // "0,0,0,0\n"

/// Converts the rows of one table to points.
class PointTableReader {
public:
    PointTableReader(const std::filesystem::path& path, const TetrahedraOptions& options)
        : options_(options), rows_(path), labels_(path) {
        rows_.next();
        columns_ = find_columns(rows_, options.columns, !options.collars.empty(), unit_);
        holes_.is_by_name = !options.collars.empty();
        holes_.path = path;
    }

    PointTable read();
    HoleTable read_holes();

private:
    void read_rows();
    void reserve();
    void add_row();
    void add_interval(double x, double y, std::uint32_t row);
    void add_depths(std::uint32_t row);
    void finish();
    double estimated_scale();

    std::string_view text(Role role) const { return rows_.field(columns_.of(role)); }
    std::string_view words(Role role) const;
    double number(Role role) const;
    std::uint32_t add_label(std::uint32_t row);
    std::uint32_t label_of_interval(std::uint32_t row);
    bool has_more_fields_than_titles() const;
    void refuse_intervals_at_one_place() const;
    void note_surface(double top);
    std::string warning_of_surface() const;

    const TetrahedraOptions& options_;
    CsvRows rows_;
    TitleUnit unit_;
    TableColumns columns_;
    TableLabels labels_;
    DrillHoles holes_;
    std::uint32_t first_depth_ = 0,
                  first_elevation_ = 0;  // first rows in which top and bottom are depths, or elevations
    PointTable table_;
    bool may_lack_labels_ = false;
    // Elevations beside a surface: whether any top is the surface, or 0 below one that is not.
    bool has_top_at_surface_ = false, has_top_at_zero_ = false;
};

/// Reserves memory for an upper bound on the rows, so that growing vectors hold nothing twice.
void PointTableReader::reserve() {
    const auto most = static_cast<std::size_t>(std::min(rows_.most_rows(kLeastRowBytes), kMostPoints));
    if (columns_.are_intervals()) {
        holes_.intervals.reserve(most);
    } else {
        table_.points.positions.reserve(most);
        table_.points.labels.reserve(most);
        table_.rows.reserve(most);
    }
}

void PointTableReader::read_rows() {
    if (options_.step && !columns_.are_intervals())
        fail(rows_.path(), "is a table of points; --step is for drill holes, with columns top and bottom");
    if (columns_.has_header && !rows_.next())
        fail(rows_.path(), "has no rows below its header; add some, or name another file");
    reserve();
    do {
        add_row();
    } while (rows_.next());
    if (!columns_.are_intervals()) return;
    if (holes_.intervals.empty()) fail(rows_.path(), "has no interval with a length; give it other bottoms");
    refuse_overlaps(holes_, labels_);
    if (holes_.is_by_name)
        place_on_paths(holes_, read_hole_paths(options_.collars, options_.surveys, options_.columns, unit_));
    else
        find_collars(holes_);
}

PointTable PointTableReader::read() {
    read_rows();
    if (columns_.are_intervals()) append_points(holes_, options_.step, table_);
    finish();
    return std::move(table_);
}

HoleTable PointTableReader::read_holes() {
    if (!columns_.are_intervals())
        fail(rows_.path(), "is a table of points; --layers is for drill holes, with columns top and bottom");
    may_lack_labels_ = true;
    read_rows();
    return {std::move(holes_), std::move(labels_), unit_.metres(), warning_of_surface()};
}

void PointTableReader::add_row() {
    if (rows_.number() > kMostPoints) rows_.refuse(fmt::format("more than {} rows; split the table", kMostPoints));
    const auto row = static_cast<std::uint32_t>(rows_.number());
    if (rows_.field_count() < columns_.least_fields)
        rows_.refuse(fmt::format("has {} fields where {} are needed; fill it or take it out", rows_.field_count(),
                                 columns_.least_fields));
    if (has_more_fields_than_titles())
        rows_.refuse(fmt::format("has {} fields where there are {} columns; put text with a separator in quotes",
                                 rows_.field_count(), columns_.titles.size()));
    if (holes_.is_by_name) return add_depths(row);
    const double x = number(Role::kX), y = number(Role::kY);
    if (columns_.are_intervals()) return add_interval(x, y, row);
    table_.points.positions.push_back({x, y, number(Role::kZ)});
    table_.points.labels.push_back(add_label(row));
    table_.rows.push_back(row);
    if (columns_.leaves_intervals) refuse_intervals_at_one_place();
}

/// Converts top and bottom to elevations. Only depths need a surface. Intervals without length (marks) are ignored.
void PointTableReader::add_interval(double x, double y, std::uint32_t row) {
    Interval interval{.x = x, .y = y, .top = number(Role::kTop), .bottom = number(Role::kBottom), .row = row};
    if (interval.top == interval.bottom) return;
    const bool is_depth = interval.top < interval.bottom;
    interval.length = std::abs(interval.top - interval.bottom);
    std::uint32_t& first = is_depth ? first_depth_ : first_elevation_;
    if (first == 0) first = row;
    if (first_depth_ != 0 && first_elevation_ != 0)
        fail(rows_.path(), fmt::format("rows {} and {}: the bottom has the larger number in row {}, the top in row {}; "
                                       "write either depths or elevations",
                                       std::min(first_depth_, first_elevation_), row, first_depth_, first_elevation_));
    if (is_depth) {
        const double surface = columns_.has(Role::kSurface) ? number(Role::kSurface) : 0;
        interval.top = surface - interval.top;
        interval.bottom = surface - interval.bottom;
        interval.collar = surface;
    } else {
        interval.collar = interval.top;
        note_surface(interval.top);
    }
    interval.from = -interval.top;
    interval.bottom_x = x;
    interval.bottom_y = y;
    if (!std::isfinite(interval.length) || !std::isfinite(interval.top) || !std::isfinite(interval.bottom))
        rows_.refuse("top and bottom are out of range; mend them");
    interval.label = label_of_interval(row);
    if (columns_.has(Role::kHole)) interval.hole = holes_.holes.number_of(words(Role::kHole));
    holes_.intervals.push_back(interval);
}

/// An interval of a hole whose path is in other tables. Until it is placed there, holes stand side by side.
void PointTableReader::add_depths(std::uint32_t row) {
    Interval interval{.from = number(Role::kTop), .row = row};
    interval.length = number(Role::kBottom) - interval.from;
    if (interval.length == 0) return;
    if (!(interval.length > 0) || !std::isfinite(interval.length))
        rows_.refuse("the bottom has the smaller number; with --collars, both are depths along the hole");
    interval.label = label_of_interval(row);
    interval.hole = holes_.holes.number_of(words(Role::kHole));
    interval.x = interval.hole;
    interval.top = -interval.from;
    interval.bottom = -interval.from - interval.length;
    holes_.intervals.push_back(interval);
}

/// The power of two nearest to the mean distance from a hole to the next, in mean distances of points of a hole.
double PointTableReader::estimated_scale() {
    if (!columns_.are_intervals()) fail(rows_.path(), "--scale-z auto is for drill holes; give a number");
    if (holes_.collars.size() > kMostHoles)
        fail(rows_.path(), fmt::format("--scale-z auto takes at most {} holes; give a number", kMostHoles));
    double length = 0;
    for (const Interval& interval : holes_.intervals) length += interval.length;
    const double distance = mean_distance(holes_.collars);
    const double between = length / static_cast<double>(table_.rows.size());
    return distance > 0 ? nearest_power_of_two(distance / between) : 1;
}

/// Replaces the numbers of label texts by labels, and scales z.
void PointTableReader::finish() {
    table_.info.source = rows_.path().string();
    table_.info.format = "csv";
    table_.info.scale_z = options_.scale_z == kAutoScale ? estimated_scale() : options_.scale_z;
    table_.info.metres = unit_.metres();
    table_.info.warning = warning_of_surface();
    if (columns_.are_intervals() && !options_.step) add_warning(table_.info.warning, kHull);
    const std::vector<InputLabel> labels = labels_.labels(table_.info);
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
        InputLabel& label = table_.points.labels[i];
        label = labels[static_cast<std::size_t>(label)];
        double& z = table_.points.positions[i].z;
        z *= table_.info.scale_z;
        if (!std::isfinite(z)) rows_.refuse(table_.rows[i], "z is out of range; give another --scale-z");
    }
}

/// A field that must not be empty.
std::string_view PointTableReader::words(Role role) const {
    const std::string_view found = text(role);
    if (found.empty()) rows_.refuse(fmt::format("column {} is empty; fill it in", columns_.titles[columns_.of(role)]));
    return found;
}

double PointTableReader::number(Role role) const {
    const std::string_view found = words(role);
    const auto number = parse_real(found);
    if (!number || !std::isfinite(*number))
        rows_.refuse(fmt::format("column {}: '{}' is no finite number; {}", columns_.titles[columns_.of(role)],
                                 shown(found),
                                 found.find(',') == std::string_view::npos ? "mend it" : "write it with a point"));
    return *number;
}

std::uint32_t PointTableReader::add_label(std::uint32_t row) {
    return labels_.add(words(Role::kLabel), columns_.has(Role::kName) ? text(Role::kName) : std::string_view(), row);
}

/// Layers: an interval without a label is one that was not logged.
std::uint32_t PointTableReader::label_of_interval(std::uint32_t row) {
    return may_lack_labels_ && text(Role::kLabel).empty() ? kNoLabel : add_label(row);
}

/// Collars, which are at one place for all intervals of a hole, and no points. Of the last two rows.
void PointTableReader::refuse_intervals_at_one_place() const {
    const auto& [positions, labels] = table_.points;
    const std::size_t n = positions.size();
    if (n < 2 || positions[n - 1] != positions[n - 2] || labels[n - 1] == labels[n - 2]) return;
    rows_.refuse(
        fmt::format("lies where row {} lies, and has another label; if these are intervals of a drill hole, say "
                    "--columns surface={}",
                    table_.rows[n - 2], columns_.of(Role::kZ) + 1));
}

void PointTableReader::note_surface(double top) {
    if (!columns_.has(Role::kSurface)) return;
    const auto surface = parse_real(text(Role::kSurface));
    has_top_at_surface_ |= surface == top && top != 0;  // 0 and 0 may be a depth below a surface at 0
    has_top_at_zero_ |= surface && *surface != 0 && top == 0;
}

/// Depths with a minus look like elevations: empty where they are none.
std::string PointTableReader::warning_of_surface() const {
    if (!has_top_at_zero_ || has_top_at_surface_) return {};
    return fmt::format(
        "top and bottom are elevations, since no bottom is larger, and column {} is not used; "
        "write depths without a minus",
        columns_.titles[columns_.of(Role::kSurface)]);
}

/// Empty fields at the end of a row are ignored.
bool PointTableReader::has_more_fields_than_titles() const {
    for (std::size_t i = columns_.titles.size(); i < rows_.field_count(); ++i)
        if (!rows_.field(i).empty()) return true;
    return false;
}

}  // namespace

HoleTable read_hole_table(const std::filesystem::path& path, const TetrahedraOptions& options) {
    return PointTableReader(path, options).read_holes();
}

PointTable read_point_table(const std::filesystem::path& path, const TetrahedraOptions& options) {
    if ((options.scale_z != kAutoScale && !(options.scale_z > 0)) || !std::isfinite(options.scale_z))
        fail(path, fmt::format("--scale-z {}: give a number above 0", options.scale_z));
    if (options.step && (!(*options.step > 0) || !std::isfinite(*options.step)))
        fail(path, fmt::format("--step {}: give a length above 0", *options.step));
    return PointTableReader(path, options).read();
}

}  // namespace regionmesh::formats
