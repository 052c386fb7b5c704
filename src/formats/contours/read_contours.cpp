#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "formats/array/volume_formats.h"
#include "formats/contours/contours.h"
#include "formats/text/csv_rows.h"
#include "formats/text/header_text.h"
#include "formats/text/json_text.h"
#include "formats/text/label_rows.h"
#include "formats/text/length_unit.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::string_view kLabels[]{"label", "region", "name", "roi", "structure"};
constexpr std::string_view kContours[]{"contour", "contourid", "polygon", "polygonid", "ring"};
constexpr std::string_view kX[]{"x"}, kY[]{"y"}, kZ[]{"z"};

struct ContourColumns {
    std::size_t label, contour, x, y, z;
};

std::optional<ContourColumns> columns_of(const CsvRows& rows) {
    std::vector<std::string> header;
    for (std::size_t n = 0; n < std::min(rows.field_count(), kMostTableColumns); ++n)
        header.emplace_back(rows.field(n));
    const auto find = [&](std::span<const std::string_view> titles) {
        return column_titled(header, titles, [](std::size_t) { return true; });
    };
    const auto label = find(kLabels), contour = find(kContours), x = find(kX), y = find(kY), z = find(kZ);
    if (!label || !contour || !x || !y || !z) return {};
    return ContourColumns{*label, *contour, *x, *y, *z};
}

/// Gives the regions their labels: the numbers where all words are labels, else 1, 2, ... and the words as names.
void set_labels(const std::vector<std::string>& words, ContourSet& set) {
    const bool are_numbers = std::ranges::all_of(words, [](const std::string& word) { return is_label(word); });
    for (std::size_t n = 0; n < words.size(); ++n) {
        set.labels.push_back(are_numbers ? *parse_table_label(words[n]) : static_cast<InputLabel>(n) + 1);
        if (!are_numbers) set.names[set.labels.back()] = one_line(words[n]);
    }
}

void require_plane(const fs::path& path, const std::string& what, double z, double other) {
    if (!(std::abs(z - other) <= 1e-6 * std::max({1.0, std::abs(z), std::abs(other)})))
        fail(path, fmt::format("{}: z is {:.9g} and {:.9g}, and a contour lies in one section; resample it to planes "
                               "of constant z",
                               what, z, other));
}

double finite(const fs::path& path, const std::string& what, const Json& number) {
    const double value = number.get<double>();
    if (!std::isfinite(value)) fail(path, what + ": has a coordinate that is no number; mend it");
    return value;
}

/// [[x, y, z], ...], or {"z": z, "points": [[x, y], ...]}.
Contour contour_of(const fs::path& path, const std::string& what, const Json& json, std::uint32_t region) {
    Contour contour{.region = region};
    const bool has_z = json.is_object();
    const Json& points = has_z ? json.at("points") : json;
    if (!points.is_array()) fail(path, what + ": has no list of points; write [[x, y, z], ...]");
    if (has_z) contour.z = finite(path, what, json.at("z"));
    for (const Json& point : points) {
        if (!point.is_array() || point.size() < (has_z ? 2u : 3u))
            fail(path,
                 fmt::format("{}: a point has {} numbers; write [{}]", what, point.size(), has_z ? "x, y" : "x, y, z"));
        contour.points.push_back({finite(path, what, point[0]), finite(path, what, point[1])});
        if (has_z) continue;
        const double z = finite(path, what, point[2]);
        if (contour.points.size() == 1) contour.z = z;
        require_plane(path, what, contour.z, z);
    }
    return contour;
}

}  // namespace

bool holds_contours(const fs::path& path) {
    const std::string own = lower(path.extension().string());
    if (own != ".csv" && own != ".tsv") return false;
    try {
        CsvRows rows(path);
        return rows.next() && columns_of(rows);
    } catch (const Error&) {
        return false;
    }
}

ContourSet read_contour_table(const fs::path& path) {
    CsvRows rows(path);
    const bool has_row = rows.next();
    const auto columns = has_row ? columns_of(rows) : std::nullopt;
    if (!columns) fail(path, "has no columns called label, contour, x, y and z; name them in its first row");
    ContourSet set;
    std::vector<std::string> words;
    std::map<std::string, std::uint32_t, std::less<>> regions;
    std::string last_contour;
    while (rows.next()) {
        const auto number = [&](std::size_t column, const char* title) {
            const auto value = parse_real(column < rows.field_count() ? rows.field(column) : "");
            if (!value || !std::isfinite(*value))
                rows.refuse(fmt::format("{} is '{}'; a number is needed", title,
                                        shown(column < rows.field_count() ? rows.field(column) : "")));
            return *value;
        };
        if (columns->label >= rows.field_count() || rows.field(columns->label).empty())
            rows.refuse("has no label; give one");
        const std::string word(rows.field(columns->label));
        const auto [region, is_new] = regions.emplace(word, static_cast<std::uint32_t>(words.size()));
        if (is_new) words.push_back(word);
        const std::string contour(columns->contour < rows.field_count() ? rows.field(columns->contour) : "");
        const double x = number(columns->x, "x"), y = number(columns->y, "y"), z = number(columns->z, "z");
        // Contours of one number in several sections, or of several regions, are several.
        if (set.contours.empty() || contour != last_contour || set.contours.back().region != region->second ||
            set.contours.back().z != z)
            set.contours.push_back({.region = region->second, .z = z});
        set.contours.back().points.push_back({x, y});
        last_contour = contour;
    }
    set_labels(words, set);
    return set;
}

ContourSet read_contour_json(const fs::path& path) {
    const std::optional<Json> json = read_json(path);
    if (!json) fail(path, "cannot be read; check the name");
    return reading(path, [&] {
        if (!json->is_object() || !json->contains("regions"))
            fail(path,
                 R"(is JSON, but no contours: {"regions": [{"name": ..., "contours": [[[x, y, z], ...], ...]}]})");
        ContourSet set;
        if (json->contains("unit")) {
            const auto unit = json->at("unit").get<std::string>();
            set.metres = metres_in(unit);
            if (!set.metres) fail(path, fmt::format("unit is '{}', which is no length; write mm", shown(unit)));
        }
        for (const Json& region : json->at("regions")) {
            const auto index = static_cast<std::uint32_t>(set.labels.size());
            const InputLabel label = region.contains("label") ? region.at("label").get<std::int64_t>() : index + 1;
            if (std::ranges::count(set.labels, label) > 0)
                fail(path, fmt::format("two regions have the label {}; give each its own", label));
            set.labels.push_back(label);
            const std::string name = region.contains("name") ? one_line(region.at("name").get<std::string>()) : "";
            if (!name.empty()) set.names[label] = name;
            std::size_t number = 0;
            for (const Json& contour : region.at("contours"))
                set.contours.push_back(
                    contour_of(path, fmt::format("region {}: contour {}", label, number++), contour, index));
        }
        return set;
    });
}

std::unique_ptr<SectionReader> open_contours(const fs::path& path, const ReadOptions& options) {
    const bool is_table = holds_contours(path);
    return contour_sections(path, is_table ? read_contour_table(path) : read_contour_json(path), options);
}

}  // namespace regionmesh::formats
