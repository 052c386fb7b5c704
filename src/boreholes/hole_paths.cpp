#include "boreholes/hole_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "boreholes/arc.h"
#include "boreholes/column_titles.h"
#include "boreholes/table_columns.h"
#include "formats/text/csv_rows.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr double kOpposite = 1e-6;  // length of the sum of two directions, below which the arc has no plane
constexpr double kLeastDepth = -1e-9;
constexpr std::size_t kMostCuts = 16;  // parts, in intervals and stations; overlaps of one unit alone make more

/// A table with a header, columns found by the words in their titles.
class NamedColumns {
public:
    explicit NamedColumns(const std::filesystem::path& path) : rows_(path) {
        if (!rows_.next()) fail(path, "is empty; a table has a header and rows");
        for (std::size_t i = 0; i < rows_.field_count(); ++i) titles_.emplace_back(rows_.field(i));
    }

    /// Requires the header to be the current row.
    std::optional<std::size_t> find(std::initializer_list<Titles> wanted) const {
        for (const Titles& titles : wanted)
            for (const std::string_view title : titles)
                for (std::size_t i = 0; i < titles_.size(); ++i) {
                    if (plain_column_title(titles_[i]) != title) continue;
                    for (std::size_t other = i + 1; other < titles_.size(); ++other)
                        if (plain_column_title(titles_[other]) == title)
                            rows_.refuse(fmt::format("columns {} and {}, '{}' and '{}', are both called {}; rename one",
                                                     i + 1, other + 1, shown(titles_[i]), shown(titles_[other]),
                                                     title));
                    return i;
                }
        return {};
    }

    /// A number counts from 1; other text is a title in any case.
    std::optional<std::size_t> titled(std::string_view title) const {
        if (const auto number = parse_size(title))
            return *number >= 1 && *number <= titles_.size() ? std::optional(*number - 1) : std::nullopt;
        for (std::size_t i = 0; i < titles_.size(); ++i)
            if (lower(titles_[i]) == lower(title)) return i;
        return {};
    }

    std::size_t require(const char* what, std::initializer_list<Titles> wanted) const {
        if (const auto column = find(wanted)) return *column;
        rows_.refuse(fmt::format("has no column for {}; call one '{}'", what, wanted.begin()->front()));
    }

    std::size_t require_hole() const { return require("the hole", {titles::kHole, titles::kName}); }

    /// Empty fields at the end of a row are ignored.
    bool next() {
        if (!rows_.next()) return false;
        for (std::size_t i = titles_.size(); i < rows_.field_count(); ++i)
            if (!rows_.field(i).empty())
                rows_.refuse(
                    fmt::format("has {} fields where there are {} columns; a comma in a number or a text needs "
                                "another separator, or quotes",
                                rows_.field_count(), titles_.size()));
        return true;
    }
    const CsvRows& rows() const { return rows_; }
    const std::string& title(std::size_t column) const { return titles_[column]; }

    std::string_view text(std::size_t column) const {
        return column < rows_.field_count() ? rows_.field(column) : std::string_view();
    }

    std::string_view hole(std::size_t column) const {
        if (text(column).empty()) rows_.refuse("names no hole; fill it in or take the row out");
        return text(column);
    }

    double number(std::size_t column) const {
        const auto number = parse_finite(text(column));
        if (!number)
            rows_.refuse(fmt::format("column '{}': '{}' is no finite number; mend it", shown(titles_[column]),
                                     shown(text(column))));
        return *number;
    }

private:
    CsvRows rows_;
    std::vector<std::string> titles_;
};

struct Collar {
    Vec3 place;
    std::uint64_t row;
};

using Collars = std::map<std::string, Collar, std::less<>>;

/// The column that a pair of --columns, "x=LOCA_NATE", names for one of `keys`; none where no pair has such a key.
std::optional<std::size_t> wanted_column(const NamedColumns& table, std::string_view wanted,
                                         std::initializer_list<std::string_view> keys) {
    if (wanted.find('=') == std::string_view::npos) return {};
    for (const std::string_view pair : split_words(wanted, ",")) {
        const std::size_t equals = std::min(pair.find('='), pair.size());
        const std::string key = lower(trim(pair.substr(0, equals)));
        if (equals == pair.size() || std::ranges::find(keys, key) == keys.end()) continue;
        const std::string_view title = trim(pair.substr(equals + 1));
        if (const auto column = table.titled(title)) return column;
        if (key != "hole")
            fail(table.rows().path(), fmt::format("has no column '{}' that --columns names for {}; its titles are in "
                                                  "the first row",
                                                  shown(title), key));
    }
    return {};
}

Collars read_collars(const std::filesystem::path& path, const std::string& wanted, TitleUnit& unit) {
    NamedColumns table(path);
    const auto column = [&](std::initializer_list<std::string_view> keys, const char* what,
                            std::initializer_list<Titles> usual) {
        const auto named = wanted_column(table, wanted, keys);
        return named ? *named : table.require(what, usual);
    };
    const std::size_t hole = column({"hole"}, "the hole", {titles::kHole, titles::kName}),
                      x = column({"x"}, "x", {titles::kX}), y = column({"y"}, "y", {titles::kY}),
                      z = column({"surface", "z"}, "the elevation", {titles::kSurface, titles::kZ});
    for (const std::size_t place : {x, y, z}) unit.add(table.rows(), table.title(place));
    Collars collars;
    while (table.next()) {
        const Collar collar{{table.number(x), table.number(y), table.number(z)}, table.rows().number()};
        const auto [known, is_new] = collars.emplace(table.hole(hole), collar);
        if (!is_new)
            table.rows().refuse(fmt::format("hole '{}' has a collar in row {}, too; keep one", shown(table.text(hole)),
                                            known->second.row));
    }
    return collars;
}

/// Stations as the table has them.
struct SurveyRow {
    std::string hole;
    double depth, azimuth, dip;  // degrees
    std::uint64_t row;
};

std::vector<SurveyRow> read_survey_rows(NamedColumns& table, bool& dips_are_inclinations, TitleUnit& unit) {
    const std::size_t hole = table.require_hole(), depth = table.require("the depth", {titles::kDepth}),
                      azimuth = table.require("the azimuth", {titles::kAzimuth});
    unit.add(table.rows(), table.title(depth));
    const auto inclination = table.find({titles::kInclination});
    dips_are_inclinations = inclination && !table.find({titles::kDip});
    const std::size_t dip = dips_are_inclinations ? *inclination : table.require("the dip", {titles::kDip});
    std::vector<SurveyRow> rows;
    while (table.next()) {
        rows.push_back({std::string(table.hole(hole)), table.number(depth), table.number(azimuth), table.number(dip),
                        table.rows().number()});
        const double angle = rows.back().dip;
        if (dips_are_inclinations && !(angle >= 0 && angle <= 180))
            table.rows().refuse(fmt::format(
                "an inclination of {} degrees; it is 0 (straight down) to 180 (straight up), mend it", angle));
        if (!dips_are_inclinations && !(std::abs(angle) <= 90))
            table.rows().refuse(
                fmt::format("a dip of {} degrees; it is -90 to 90 from the horizontal, mend it", angle));
        if (rows.back().depth < 0)
            table.rows().refuse(fmt::format("a depth of {}; it is 0 or more along the hole", rows.back().depth));
    }
    return rows;
}

using Stations = std::map<std::string, std::vector<Station>, std::less<>>;

/// The stations of holes that have a collar.
Stations read_stations(const std::filesystem::path& path, const std::filesystem::path& collars, const Collars& known,
                       TitleUnit& unit) {
    NamedColumns table(path);
    bool are_inclinations = false;
    std::vector<SurveyRow> rows = read_survey_rows(table, are_inclinations, unit);
    for (const SurveyRow& row : rows)
        if (!known.contains(row.hole))
            table.rows().refuse(row.row, fmt::format("hole '{}' has a station but no collar in {}; add its row there",
                                                     shown(row.hole), collars.string()));
    const auto negative = std::ranges::count_if(rows, [](const SurveyRow& row) { return row.dip < 0; });
    const auto positive = std::ranges::count_if(rows, [](const SurveyRow& row) { return row.dip > 0; });
    const double sign = negative > positive ? -1 : 1;
    std::ranges::stable_sort(rows, {}, &SurveyRow::depth);
    Stations stations;
    for (const SurveyRow& row : rows) {
        const double degree = std::numbers::pi / 180;
        const double down = are_inclinations ? (90 - row.dip) * degree : sign * row.dip * degree;
        const double azimuth = row.azimuth * degree;
        std::vector<Station>& of_hole = stations[row.hole];
        if (!of_hole.empty() && of_hole.back().depth == row.depth)
            table.rows().refuse(
                row.row, fmt::format("hole '{}' has two stations at depth {}; keep one", shown(row.hole), row.depth));
        const Station station{
            row.depth, {std::cos(down) * std::sin(azimuth), std::cos(down) * std::cos(azimuth), -std::sin(down)}};
        if (!of_hole.empty() && length(of_hole.back().direction + station.direction) < kOpposite)
            table.rows().refuse(
                row.row, fmt::format("hole '{}' turns back, by 180 degrees, between depths {} and {}; no one arc "
                                     "does that, mend a station or add one between",
                                     shown(row.hole), of_hole.back().depth, row.depth));
        of_hole.push_back(station);
    }
    return stations;
}

}  // namespace

HolePath::HolePath(Vec3 collar, std::vector<Station> stations) : stations_(std::move(stations)) {
    places_.push_back(collar + stations_[0].direction * stations_[0].depth);
    for (std::size_t n = 1; n < stations_.size(); ++n) {
        const Station &a = stations_[n - 1], &b = stations_[n];
        places_.push_back(places_.back() + along_arc(a.direction, b.direction, b.depth - a.depth));
    }
}

Vec3 HolePath::at(double depth) const {
    const auto after = std::ranges::upper_bound(stations_, depth, {}, &Station::depth);
    const auto n = static_cast<std::size_t>(after - stations_.begin());
    if (n == 0) return places_[0] + stations_[0].direction * (depth - stations_[0].depth);
    const Station& a = stations_[n - 1];
    const double length = depth - a.depth;
    if (n == stations_.size()) return places_[n - 1] + a.direction * length;
    const Station& b = stations_[n];
    const Vec3 here = between(a.direction, b.direction, length / (b.depth - a.depth));
    return places_[n - 1] + along_arc(a.direction, here, length);
}

Vec3 HolePath::direction_at(double depth) const {
    const auto after = std::ranges::upper_bound(stations_, depth, {}, &Station::depth);
    if (after == stations_.begin()) return stations_.front().direction;
    if (after == stations_.end()) return stations_.back().direction;
    const Station &a = after[-1], &b = after[0];
    return between(a.direction, b.direction, (depth - a.depth) / (b.depth - a.depth));
}

HolePaths read_hole_paths(const std::filesystem::path& collars, const std::filesystem::path& surveys,
                          const std::string& columns, TitleUnit& unit) {
    const Collars known = read_collars(collars, columns, unit);
    Stations stations;
    if (!surveys.empty()) stations = read_stations(surveys, collars, known, unit);
    HolePaths paths;
    for (const auto& [hole, collar] : known) {
        const auto found = stations.find(hole);
        paths.emplace(hole, HolePath(collar.place, found == stations.end() ? std::vector<Station>{{}} : found->second));
    }
    return paths;
}

namespace {

const HolePath& path_of(const DrillHoles& holes, const Interval& interval, const HolePaths& paths) {
    const auto found = paths.find(holes.holes.text(interval.hole));
    if (found == paths.end())
        fail(holes.path, fmt::format("row {}: hole '{}' has no row in --collars; add it", interval.row,
                                     shown(holes.holes.text(interval.hole))));
    if (interval.from < kLeastDepth)
        fail(holes.path, fmt::format("row {}: depth {} is above the collar; with --collars, from and to are depths",
                                     interval.row, interval.from));
    return found->second;
}

/// The stations inside an interval, ends excluded.
std::span<const Station> stations_in(const HolePath& path, const Interval& interval) {
    const auto& stations = path.stations();
    const auto first = std::ranges::upper_bound(stations, interval.from, {}, &Station::depth);
    const auto last = std::ranges::lower_bound(stations, interval.from + interval.length, {}, &Station::depth);
    return {first, std::max(first, last)};
}

/// Intervals that hardly overlap are cut about once a station. Without the limit, a table of long intervals in the same
/// unit at the same depths would make intervals times stations of parts.
std::size_t count_parts(const DrillHoles& holes, const HolePaths& paths) {
    std::size_t stations = 0, parts = 0;
    for (const auto& [hole, path] : paths) stations += path.stations().size();
    const std::size_t most = kMostCuts * (holes.intervals.size() + stations);
    for (const Interval& interval : holes.intervals) {
        parts += stations_in(path_of(holes, interval, paths), interval).size() + 1;
        if (parts > most)
            fail(holes.path, fmt::format("row {}: intervals of hole '{}' overlap so often that stations cut them into "
                                         "more than {} parts; give each depth once",
                                         interval.row, shown(holes.holes.text(interval.hole)), most));
    }
    return parts;
}

}  // namespace

void place_on_paths(DrillHoles& holes, const HolePaths& paths) {
    std::vector<Interval> placed;
    placed.reserve(count_parts(holes, paths));
    std::vector<bool> has_collar(holes.holes.size());
    for (const Interval& whole : holes.intervals) {
        const HolePath& path = path_of(holes, whole, paths);
        if (!has_collar[whole.hole]) {
            const Vec3 collar = path.at(0);
            holes.collars.push_back({collar.x, collar.y, collar.z});
            has_collar[whole.hole] = true;
        }
        double from = whole.from;
        const auto add_part = [&](double to) {
            const Vec3 a = path.at(from), b = path.at(to);
            Interval part = whole;
            part.x = a.x, part.y = a.y, part.top = a.z;
            part.bottom_x = b.x, part.bottom_y = b.y, part.bottom = b.z;
            part.upper = path.direction_at(from), part.lower = path.direction_at(to);
            part.from = from;
            part.length = to - from;
            part.is_at_collar = part.from <= 0;
            placed.push_back(part);
            from = to;
        };
        for (const Station& station : stations_in(path, whole)) add_part(station.depth);
        add_part(whole.from + whole.length);
    }
    holes.intervals = std::move(placed);
}

}  // namespace regionmesh::formats
