#include "boreholes/table_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <span>
#include <string_view>

#include "boreholes/column_titles.h"
#include "formats/text/header_text.h"
#include "formats/text/length_unit.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using Words = std::vector<std::string_view>;

class ColumnFinder {
public:
    ColumnFinder(const CsvRows& rows, bool has_collars) : rows_(rows), has_collars_(has_collars) {}

    TableColumns find(const std::string& wanted);

private:
    void take_wanted(const std::string& wanted);
    bool is_of_collars(const std::string& key, std::string_view column) const;
    void require_own_columns(const std::string& wanted) const;
    std::size_t wanted_column(std::string_view column);
    std::optional<std::size_t> column_like(std::string_view title, std::string (*plain)(std::string_view)) const;
    void look_for(Role role, Titles titles);
    bool has_title(Titles titles) const;
    void choose_kind();
    [[noreturn]] void refuse_without(const std::string& what) const;
    [[noreturn]] void refuse_option(const std::string& text) const {
        throw Error(ErrorCode::kUsage, rows_.path().string() + ": --columns" + text);
    }

    std::optional<std::size_t>& place(Role role) { return found_.places[static_cast<std::size_t>(role)]; }
    bool is_number(std::size_t column) const { return parse_real(rows_.field(column)).has_value(); }

    void find_place();

    const CsvRows& rows_;
    bool has_collars_;
    TableColumns found_;
    bool is_by_number_ = true;  // whether `wanted` gives every column by number
};

/// A number counts from 1; other text is a title, compared first exactly, then without regard to case.
std::size_t ColumnFinder::wanted_column(std::string_view column) {
    if (column.empty()) refuse_option(" names an empty column; give its number");
    if (const auto number = parse_size(column)) {
        if (*number == 0 || *number > rows_.field_count())
            rows_.refuse(fmt::format("has columns 1 to {}; --columns names {}", rows_.field_count(), *number));
        return *number - 1;
    }
    is_by_number_ = false;
    auto place = column_like(column, [](std::string_view title) { return std::string(title); });
    if (!place) place = column_like(column, lower);
    if (!place) refuse_without(fmt::format("column '{}' that --columns names", shown(column)));
    return *place;
}

std::optional<std::size_t> ColumnFinder::column_like(std::string_view title,
                                                     std::string (*plain)(std::string_view)) const {
    std::optional<std::size_t> place;
    for (std::size_t i = 0; i < rows_.field_count(); ++i) {
        if (plain(rows_.field(i)) != plain(title)) continue;
        if (place)
            rows_.refuse(fmt::format("columns {} and {} are both called '{}'; choose one by number with --columns",
                                     *place + 1, i + 1, shown(rows_.field(i))));
        place = i;
    }
    return place;
}

void ColumnFinder::take_wanted(const std::string& wanted) {
    constexpr std::array kInOrder{Role::kX, Role::kY, Role::kZ, Role::kLabel};
    constexpr std::string_view kRemedy = "write four columns for x, y, z and label, or pairs like 'x=east,label=3'";
    Words parts;
    for (std::string_view rest = wanted;; rest.remove_prefix(parts.back().size() + 1)) {
        parts.push_back(rest.substr(0, rest.find(',')));
        if (parts.back().size() == rest.size()) break;
    }
    const bool has_pairs = wanted.find('=') != std::string::npos;
    if (!has_pairs && parts.size() != kInOrder.size()) refuse_option(fmt::format(" {}: {}", shown(wanted), kRemedy));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::size_t role = static_cast<std::size_t>(kInOrder[std::min<std::size_t>(i, 3)]);
        std::string_view column = parts[i];
        if (has_pairs) {
            const std::size_t equals = std::min(column.find('='), column.size());
            const std::string key = lower(trim(column.substr(0, equals)));
            if (has_collars_ && equals < column.size() && is_of_collars(key, trim(column.substr(equals + 1)))) continue;
            role = static_cast<std::size_t>(std::find(kRoleNames.begin(), kRoleNames.end(), key) - kRoleNames.begin());
            if (equals == column.size() || role == kRoleNames.size() || found_.places[role])
                refuse_option(
                    fmt::format(" {}: '{}' {}; {}", shown(wanted), shown(column),
                                role < kRoleNames.size() && found_.places[role] ? "comes twice" : "is no pair",
                                "a pair is x, y, z, label, name, top, bottom, surface or hole, = and a column"));
            column.remove_prefix(equals + 1);
        }
        found_.places[role] = wanted_column(trim(column));
    }
    require_own_columns(wanted);
}

/// With a table of collars, the place of a hole stands there, and its name in both.
bool ColumnFinder::is_of_collars(const std::string& key, std::string_view column) const {
    if (key == "x" || key == "y" || key == "z" || key == "surface") return true;
    return key == "hole" && !parse_size(column) && !column_like(column, lower);
}

/// A label may be taken from any column, a coordinate has one of its own.
void ColumnFinder::require_own_columns(const std::string& wanted) const {
    std::map<std::size_t, Role> roles;
    const auto name_of = [](Role role) { return kRoleNames[static_cast<std::size_t>(role)]; };
    for (const Role role : {Role::kX, Role::kY, Role::kZ, Role::kTop, Role::kBottom}) {
        if (!found_.has(role)) continue;
        const auto [first, is_new] = roles.emplace(found_.of(role), role);
        if (!is_new)
            refuse_option(fmt::format(" {}: column {} is both {} and {}; give each its own", shown(wanted),
                                      first->first + 1, name_of(first->second), name_of(role)));
    }
}

void ColumnFinder::look_for(Role role, Titles titles) {
    if (!found_.has_header) return;  // the first row is data
    for (std::size_t i = 0; !place(role) && i < titles.size(); ++i)
        place(role) = column_like(titles[i], plain_column_title);
}

bool ColumnFinder::has_title(Titles titles) const {
    for (std::size_t i = 0; found_.has_header && i < rows_.field_count(); ++i)
        if (std::ranges::find(titles, plain_column_title(rows_.field(i))) != titles.end()) return true;
    return false;
}

/// A column of a table of intervals called `elevation` is that of the surface, unless --columns says otherwise.
void ColumnFinder::choose_kind() {
    const bool has_interval = found_.has(Role::kTop) || found_.has(Role::kBottom) || found_.has(Role::kSurface);
    if (found_.has(Role::kZ) && has_interval)
        refuse_option(" names z and also top, bottom or surface; points have a z, intervals have the others");
    if (!has_interval) look_for(Role::kZ, titles::kZ);
    if (found_.has(Role::kZ)) {
        found_.leaves_intervals = has_title(titles::kTop) && has_title(titles::kBottom);
        return;
    }
    look_for(Role::kTop, titles::kTop);
    look_for(Role::kBottom, titles::kBottom);
    if (found_.has(Role::kTop) && found_.has(Role::kBottom)) {
        look_for(Role::kSurface, titles::kSurface);
        look_for(Role::kHole, titles::kHole);
        return;
    }
    if (has_interval) refuse_without(found_.has(Role::kTop) ? "column for bottom" : "column for top");
    look_for(Role::kZ, titles::kElevation);
    if (!found_.has(Role::kZ)) refuse_without("column for z, nor both of top and bottom");
    place(Role::kTop) = place(Role::kBottom) = std::nullopt;
}

void ColumnFinder::find_place() {
    if (has_collars_) {
        choose_kind();
        if (!found_.are_intervals()) refuse_without("columns for top and bottom");
        if (!found_.has(Role::kHole)) refuse_without("column for the hole");
        place(Role::kSurface) = std::nullopt;
        return;
    }
    look_for(Role::kX, titles::kX);
    if (!found_.has(Role::kX)) refuse_without("column for x");
    look_for(Role::kY, titles::kY);
    if (!found_.has(Role::kY)) refuse_without("column for y");
    choose_kind();
}

TableColumns ColumnFinder::find(const std::string& wanted) {
    if (!wanted.empty()) take_wanted(wanted);
    const bool is_data = !wanted.empty() && is_by_number_ && found_.has(Role::kX) && found_.has(Role::kY) &&
                         is_number(found_.of(Role::kX)) && is_number(found_.of(Role::kY));
    found_.has_header = !is_data;
    find_place();
    look_for(Role::kLabel, titles::kLabel);
    if (!found_.has(Role::kLabel)) refuse_without("column for label");
    for (std::size_t i = 0; i < rows_.field_count(); ++i)
        found_.titles.push_back(is_data || rows_.field(i).empty() ? std::to_string(i + 1)
                                                                  : "'" + shown(rows_.field(i)) + "'");
    for (const auto& at : found_.places)
        if (at) found_.least_fields = std::max(found_.least_fields, *at + 1);
    return found_;
}

void ColumnFinder::refuse_without(const std::string& what) const {
    std::size_t numbers = 0;
    std::string titles;
    for (std::size_t i = 0; i < rows_.field_count(); ++i) {
        numbers += is_number(i);
        if (i < 12) titles += (i == 0 ? "'" : ", '") + shown(rows_.field(i)) + "'";
    }
    if (rows_.field_count() > 12) titles += ", ...";
    if (2 * numbers > rows_.field_count())
        rows_.refuse("is no header: it holds numbers; say which column is what: --columns 1,2,3,4 for x, y, z, label");
    rows_.refuse(fmt::format("has no {}, only {}; say which column is what: --columns {}=COLUMN,label=COLUMN", what,
                             titles, has_collars_ ? "hole" : "x"));
}

constexpr std::string_view kBetweenWords = " \t\r\n_-.";

/// The metres of a unit in a title, in small letters: "ft", "in.". Heights such as "masl" (metres above sea level) and
/// "m.b.g.l." (below ground level) are in metres. "fm" and "pm" are no units of tables.
std::optional<double> metres_in_word(std::string_view word) {
    while (word.ends_with('.')) word.remove_suffix(1);
    std::string letters(word);
    std::erase(letters, '.');
    constexpr std::array<std::string_view, 5> kHeights{"masl", "mamsl", "mbsl", "mbgl", "mbgs"};
    if (std::ranges::find(kHeights, letters) != kHeights.end()) return 1;
    return word == "fm" || word == "pm" ? std::nullopt : metres_in(word);
}

/// Whether the last word of a title without brackets is a unit: "in" may be a word.
bool is_unit(std::string_view word) { return word != "in" && metres_in_word(word).has_value(); }

/// The metres of the unit in a title: of the first unit in brackets, or else of a last word that is one. "in" is one
/// where it stands alone: not in "z (in m)". None after a number: "x (1000 m)".
std::optional<double> metres_in_title(std::string_view title) {
    const std::string lowered = lower(title);
    const std::size_t bracket = lowered.find_first_of("([");
    const Words words = split_words(std::string_view(lowered).substr(0, bracket), kBetweenWords);
    if (bracket != std::string::npos) {
        const Words inside = split_words(std::string_view(lowered).substr(bracket), " \t\r\n_-,()[]");
        for (const std::string_view word : inside) {
            if (parse_real(word)) break;
            if (const auto metres = word == "in" && inside.size() > 1 ? std::nullopt : metres_in_word(word))
                return metres;
        }
    }
    return words.size() > 1 && is_unit(words.back()) ? metres_in_word(words.back()) : std::nullopt;
}

}  // namespace

void TitleUnit::add(const CsvRows& rows, std::string_view title) {
    const auto metres = metres_in_title(title);
    if (!metres) return;
    if (!metres_) {
        metres_ = metres;
        where_ = fmt::format("'{}' in {}", shown(title), rows.path().string());
    }
    if (metres != metres_)
        rows.refuse(
            fmt::format("column '{}' is in another unit of length than {}; convert one of them", shown(title), where_));
}

std::string plain_column_title(std::string_view title) {
    const std::string lowered = lower(title.substr(0, title.find_first_of("([")));
    Words words = split_words(lowered, kBetweenWords);
    if (words.size() > 1 && is_unit(words.back())) words.pop_back();
    std::string plain;
    for (const std::string_view word : words) plain += word;
    return plain;
}

TableColumns find_columns(const CsvRows& rows, const std::string& wanted, bool has_collars, TitleUnit& unit) {
    TableColumns found = ColumnFinder(rows, has_collars).find(wanted);
    for (const Role role : {Role::kX, Role::kY, Role::kZ, Role::kTop, Role::kBottom, Role::kSurface})
        if (found.has_header && found.has(role)) unit.add(rows, rows.field(found.of(role)));
    return found;
}

}  // namespace regionmesh::formats
