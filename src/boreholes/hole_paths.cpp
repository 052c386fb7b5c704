#include "boreholes/hole_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "boreholes/table_columns.h"
#include "formats/text/csv_rows.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr double kStraight = 1e-6;  // radians, below which an arc is a line
constexpr double kLeastDepth = -1e-9;

/// The vector along the arc from a direction to another, for a length of the arc.
Vec3 along_arc(Vec3 from, Vec3 to, double measured) {
    const double angle = 2 * std::asin(std::min(1.0, length(to - from) / 2));
    const double factor = angle < kStraight ? 1 : 2 / angle * std::tan(angle / 2);
    return (from + to) * (measured / 2 * factor);
}

/// The direction at a share of the arc between two.
Vec3 between(Vec3 from, Vec3 to, double share) {
    const double angle = 2 * std::asin(std::min(1.0, length(to - from) / 2));
    if (angle < kStraight) return from;
    return (from * std::sin((1 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
}

using Words = std::vector<std::string_view>;

/// A table with a header, columns found by the words in their titles.
class NamedColumns {
public:
    explicit NamedColumns(const std::filesystem::path& path) : rows_(path) {
        if (!rows_.next()) fail(path, "is empty; a table has a header and rows");
        for (std::size_t i = 0; i < rows_.field_count(); ++i) titles_.push_back(plain_column_title(rows_.field(i)));
    }

    std::optional<std::size_t> find(const Words& words) const {
        for (const std::string_view word : words)
            for (std::size_t i = 0; i < titles_.size(); ++i)
                if (titles_[i] == word) return i;
        return {};
    }

    std::size_t require(const char* what, const Words& words) const {
        if (const auto column = find(words)) return *column;
        rows_.refuse(fmt::format("has no column for {}; call one '{}'", what, words[0]));
    }

    bool next() { return rows_.next(); }
    const CsvRows& rows() const { return rows_; }

    std::string_view text(std::size_t column) const {
        return column < rows_.field_count() ? rows_.field(column) : std::string_view();
    }

    double number(std::size_t column) const {
        const auto number = parse_finite(text(column));
        if (!number)
            rows_.refuse(fmt::format("column {}: '{}' is no finite number; mend it", column + 1, shown(text(column))));
        return *number;
    }

private:
    CsvRows rows_;
    std::vector<std::string> titles_;
};

const Words kHoleTitles{"hole", "holeid", "bhid", "borehole", "well", "name"};

struct Collar {
    Vec3 place;
    std::uint64_t row;
};

std::map<std::string, Collar, std::less<>> read_collars(const std::filesystem::path& path) {
    NamedColumns table(path);
    const std::size_t hole = table.require("the hole", kHoleTitles), x = table.require("x", {"x", "easting", "east"}),
                      y = table.require("y", {"y", "northing", "north"}),
                      z = table.require("the elevation", {"surface", "z", "elevation", "elev", "collar", "altitude"});
    std::map<std::string, Collar, std::less<>> collars;
    while (table.next()) {
        const Collar collar{{table.number(x), table.number(y), table.number(z)}, table.rows().number()};
        const auto [known, is_new] = collars.emplace(table.text(hole), collar);
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

std::vector<SurveyRow> read_survey_rows(NamedColumns& table, bool& dips_are_inclinations) {
    const std::size_t hole = table.require("the hole", kHoleTitles),
                      depth = table.require("the depth", {"depth", "md", "at", "distance", "from"}),
                      azimuth = table.require("the azimuth", {"azimuth", "azi", "az", "bearing"});
    const auto inclination = table.find({"inclination", "inc", "incl"});
    dips_are_inclinations = inclination && !table.find({"dip"});
    const std::size_t dip = dips_are_inclinations ? *inclination : table.require("the dip", {"dip"});
    std::vector<SurveyRow> rows;
    while (table.next()) {
        rows.push_back({std::string(table.text(hole)), table.number(depth), table.number(azimuth), table.number(dip),
                        table.rows().number()});
        if (!(std::abs(rows.back().dip) <= (dips_are_inclinations ? 180 : 90)))
            table.rows().refuse(fmt::format("a dip of {} degrees; it lies between -90 and 90", rows.back().dip));
        if (rows.back().depth < 0)
            table.rows().refuse(fmt::format("a depth of {}; it is 0 or more along the hole", rows.back().depth));
    }
    return rows;
}

std::map<std::string, std::vector<Station>, std::less<>> read_stations(const std::filesystem::path& path) {
    NamedColumns table(path);
    bool are_inclinations = false;
    std::vector<SurveyRow> rows = read_survey_rows(table, are_inclinations);
    const auto negative = std::ranges::count_if(rows, [](const SurveyRow& row) { return row.dip < 0; });
    const double sign = 2 * static_cast<std::size_t>(negative) > rows.size() ? -1 : 1;
    std::ranges::stable_sort(rows, {}, &SurveyRow::depth);
    std::map<std::string, std::vector<Station>, std::less<>> stations;
    for (const SurveyRow& row : rows) {
        const double degree = std::numbers::pi / 180;
        const double down = are_inclinations ? (90 - row.dip) * degree : sign * row.dip * degree;
        const double azimuth = row.azimuth * degree;
        std::vector<Station>& of_hole = stations[row.hole];
        if (!of_hole.empty() && of_hole.back().depth == row.depth)
            table.rows().refuse(
                row.row, fmt::format("hole '{}' has two stations at depth {}; keep one", shown(row.hole), row.depth));
        of_hole.push_back(
            {row.depth, Vec3{std::cos(down) * std::sin(azimuth), std::cos(down) * std::cos(azimuth), -std::sin(down)}});
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

HolePaths read_hole_paths(const std::filesystem::path& collars, const std::filesystem::path& surveys) {
    std::map<std::string, std::vector<Station>, std::less<>> stations;
    if (!surveys.empty()) stations = read_stations(surveys);
    const auto known = read_collars(collars);
    for (const auto& [hole, of_hole] : stations)
        if (!known.contains(hole))
            fail(surveys, fmt::format("hole '{}' has stations but no collar in {}; add its row there", shown(hole),
                                      collars.string()));
    HolePaths paths;
    for (const auto& [hole, collar] : known) {
        const auto found = stations.find(hole);
        paths.emplace(hole, HolePath(collar.place, found == stations.end() ? std::vector<Station>{{}} : found->second));
    }
    return paths;
}

void place_on_paths(DrillHoles& holes, const HolePaths& paths) {
    std::vector<Interval> placed;
    std::vector<bool> has_collar(holes.holes.size());
    for (const Interval& whole : holes.intervals) {
        const auto found = paths.find(holes.holes.text(whole.hole));
        if (found == paths.end())
            fail(holes.path, fmt::format("row {}: hole '{}' has no row in --collars; add it", whole.row,
                                         shown(holes.holes.text(whole.hole))));
        const HolePath& path = found->second;
        if (!has_collar[whole.hole]) {
            const Vec3 collar = path.at(0);
            holes.collars.push_back({collar.x, collar.y, collar.z});
            has_collar[whole.hole] = true;
        }
        if (whole.from < kLeastDepth)
            fail(holes.path, fmt::format("row {}: depth {} is above the collar; with --collars, from and to are depths",
                                         whole.row, whole.from));
        const double end = whole.from + whole.length;
        std::vector<double> cuts{whole.from};
        for (const Station& station : path.stations())
            if (station.depth > whole.from && station.depth < end) cuts.push_back(station.depth);
        cuts.push_back(end);
        for (std::size_t n = 1; n < cuts.size(); ++n) {
            const Vec3 a = path.at(cuts[n - 1]), b = path.at(cuts[n]);
            Interval part = whole;
            part.x = a.x, part.y = a.y, part.top = a.z;
            part.bottom_x = b.x, part.bottom_y = b.y, part.bottom = b.z;
            part.from = cuts[n - 1];
            part.length = cuts[n] - cuts[n - 1];
            part.is_at_collar = part.from <= 0;
            placed.push_back(part);
        }
    }
    holes.intervals = std::move(placed);
}

}  // namespace regionmesh::formats
