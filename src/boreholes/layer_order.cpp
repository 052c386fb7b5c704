#include "boreholes/layer_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint32_t kNoUnit = std::numeric_limits<std::uint32_t>::max();
constexpr double kLeastOrder = 0.5;  // share of the logged length
constexpr double kMostGap = 0.01;    // share of the shorter interval beside it: a boundary recorded twice

/// The intervals of one hole, from its top down.
using Hole = std::vector<const Interval*>;

std::vector<Hole> holes_of(const DrillHoles& table) {
    std::vector<const Interval*> all;
    for (const Interval& interval : table.intervals) all.push_back(&interval);
    const auto place = [&](const Interval* i) {
        return table.is_by_name ? std::tuple(0.0, 0.0, i->hole) : std::tuple(i->x, i->y, std::uint32_t{0});
    };
    std::sort(all.begin(), all.end(), [&](const Interval* a, const Interval* b) {
        return std::tuple(place(a), a->from, a->row) < std::tuple(place(b), b->from, b->row);
    });
    std::vector<Hole> found;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (n == 0 || place(all[n]) != place(all[n - 1])) found.emplace_back();
        found.back().push_back(all[n]);
    }
    return found;
}

/// Units above others: counts[a, b] pairs of intervals of a hole with unit a above unit b.
class PairCounts {
public:
    PairCounts(std::span<const Hole> holes, const std::vector<std::uint32_t>& place_of, std::size_t size)
        : counts_(size * size), size_(size) {
        for (const Hole& hole : holes) {
            std::vector<double> above(size);
            std::uint32_t last = kNoUnit;
            for (const Interval* interval : hole) {
                const std::uint32_t unit = interval->label == kNoLabel ? kNoUnit : place_of[interval->label];
                if (unit == kNoUnit || unit == last) continue;
                last = unit;
                for (std::size_t a = 0; a < size; ++a) counts_[a * size + unit] += above[a];
                ++above[unit];
            }
        }
    }

    /// How much more often a lies above b than below.
    double excess(std::size_t a, std::size_t b) const { return counts_[a * size_ + b] - counts_[b * size_ + a]; }

private:
    std::vector<double> counts_;
    std::size_t size_;
};

/// Moves one unit at a time to the place where the fewest pairs are out of order, while that helps.
void improve(std::vector<std::size_t>& order, const PairCounts& counts) {
    for (bool has_moved = true; has_moved;) {
        has_moved = false;
        for (std::size_t i = 0; i < order.size(); ++i) {
            double best = 0;
            std::size_t target = i;
            double gain = 0;
            for (std::size_t j = i; j-- > 0;)
                if ((gain += counts.excess(order[i], order[j])) > best) best = gain, target = j;
            gain = 0;
            for (std::size_t j = i + 1; j < order.size(); ++j)
                if ((gain += counts.excess(order[j], order[i])) > best) best = gain, target = j;
            if (target == i) continue;
            const auto at = [&](std::size_t n) { return order.begin() + static_cast<std::ptrdiff_t>(n); };
            if (target < i)
                std::rotate(at(target), at(i), at(i + 1));
            else
                std::rotate(at(i), at(i + 1), at(target + 1));
            has_moved = true;
        }
    }
}

/// Units with numbers of TableLabels; those that lie highest first, then improved.
std::vector<std::uint32_t> found_order(std::span<const Hole> holes, const std::vector<std::uint32_t>& units,
                                       std::size_t label_count) {
    std::vector<std::uint32_t> place_of(label_count, kNoUnit);
    for (std::uint32_t n = 0; n < units.size(); ++n) place_of[units[n]] = n;
    const PairCounts counts(holes, place_of, units.size());
    std::vector<double> excess(units.size());
    for (std::size_t a = 0; a < units.size(); ++a)
        for (std::size_t b = 0; b < units.size(); ++b) excess[a] += counts.excess(a, b);
    std::vector<std::size_t> order(units.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return excess[a] > excess[b]; });
    improve(order, counts);
    std::vector<std::uint32_t> sorted;
    for (const std::size_t n : order) sorted.push_back(units[n]);
    return sorted;
}

/// The units that `wanted` lists, in its order, with those for "auto" in their place.
class WantedUnits {
public:
    WantedUnits(const DrillHoles& table, const TableLabels& labels) : path_(table.path), labels_(labels) {
        for (const Interval& interval : table.intervals)
            if (interval.label != kNoLabel) used_.push_back(interval.label);
        // Units in byte order of their texts, so that the order of rows decides nothing.
        std::sort(used_.begin(), used_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return labels.text(a) < labels.text(b); });
        used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
        for (const std::uint32_t unit : used_)
            most_commas_ = std::max(most_commas_, std::ranges::count(labels.text(unit), ','));
    }

    std::vector<std::uint32_t> find(const std::string& wanted, std::span<const Hole> holes) {
        std::optional<std::size_t> place_of_rest;
        std::vector<std::uint32_t> units, others;
        for (std::string_view rest = wanted; !rest.empty();) {
            const std::string_view word = take_word(rest);
            if (word == "auto") {
                if (place_of_rest) refuse_twice(word);
                place_of_rest = units.size();
                continue;
            }
            const bool is_left_out = word.starts_with('-') && !is_unit(word);
            const std::uint32_t unit = unit_of(is_left_out ? word.substr(1) : word);
            if (std::ranges::count(units, unit) + std::ranges::count(others, unit) > 0) refuse_twice(word);
            (is_left_out ? others : units).push_back(unit);
        }
        std::vector<std::uint32_t> unnamed;
        for (const std::uint32_t unit : used_)
            if (std::ranges::count(units, unit) + std::ranges::count(others, unit) == 0) unnamed.push_back(unit);
        if (place_of_rest) {
            require_size(unnamed.size());
            const auto rest = found_order(holes, std::exchange(unnamed, {}), labels_.count());
            units.insert(units.begin() + static_cast<std::ptrdiff_t>(*place_of_rest), rest.begin(), rest.end());
        }
        require_size(units.size());
        if (units.size() < 2)
            fail(path_, "--layers has fewer than two units; name all units from young to old, or give auto");
        if (!unnamed.empty())
            fail(path_,
                 fmt::format("--layers does not name the unit '{0}'; add it, '-{0}' to leave it out, or auto for "
                             "all others",
                             shown(labels_.text(unnamed.front()))));
        return units;
    }

private:
    bool is_unit(std::string_view text) const {
        return std::ranges::any_of(used_, [&](std::uint32_t unit) { return labels_.text(unit) == text; });
    }

    /// Takes the text up to the next comma, or up to a later one where that is a unit.
    std::string_view take_word(std::string_view& rest) const {
        std::size_t first = std::min(rest.find(','), rest.size()), end = first;
        for (std::ptrdiff_t commas = 0; commas < most_commas_ && end < rest.size(); ++commas) {
            end = std::min(rest.find(',', end + 1), rest.size());
            const std::string_view word = trim(rest.substr(0, end));
            if (is_unit(word) || (word.starts_with('-') && is_unit(word.substr(1)))) first = end;
        }
        const std::string_view word = trim(rest.substr(0, first));
        rest.remove_prefix(std::min(first + 1, rest.size()));
        return word;
    }

    std::uint32_t unit_of(std::string_view text) const {
        for (const std::uint32_t unit : used_)
            if (labels_.text(unit) == text) return unit;
        std::string known;
        for (std::size_t n = 0; n < used_.size() && n < 12; ++n)
            known.append(n ? ", " : "").append(shown(labels_.text(used_[n])));
        fail(path_, fmt::format("--layers: no interval has the unit '{}'; units are {}{}", shown(text), known,
                                used_.size() > 12 ? ", ..." : ""));
    }

    [[noreturn]] void refuse_twice(std::string_view word) const {
        throw Error(ErrorCode::kUsage,
                    fmt::format("{}: --layers names '{}' twice; name it once", path_.string(), shown(word)));
    }

    void require_size(std::size_t count) const {
        if (count > kMostUnits)
            fail(path_,
                 fmt::format("has {} units; --layers takes at most {}, join or leave out some", count, kMostUnits));
    }

    const std::filesystem::path& path_;
    const TableLabels& labels_;
    std::vector<std::uint32_t> used_;
    std::ptrdiff_t most_commas_ = 0;  // most commas in the text of a unit
};

/// Finds the bases in one hole.
class HoleContacts {
public:
    HoleContacts(const Hole& hole, const std::vector<std::uint32_t>& rank_of) {
        for (const Interval* interval : hole) {
            const std::uint32_t rank = interval->label == kNoLabel ? kNoUnit : rank_of[interval->label];
            if (rank != kNoUnit) logged_.push_back({interval, rank});
        }
        starts_at_ground_ = !logged_.empty() && logged_[0].interval == hole[0] && hole[0]->is_at_collar;
    }

    bool is_empty() const { return logged_.empty(); }

    /// Appends what the hole says about the base of unit `rank`.
    void append_contacts(std::uint32_t rank, std::vector<Contact>& contacts) const {
        const std::size_t cut = cut_of(rank);
        if (cut == 0) {
            const Interval& first = *logged_[0].interval;
            contacts.push_back(
                {first.x, first.y, first.top, starts_at_ground_ ? ContactKind::kGround : ContactKind::kAtLeast});
            return;
        }
        const auto& [upper, rank_above] = logged_[cut - 1];
        const Interval& above = *upper;
        if (cut == logged_.size()) {
            contacts.push_back({above.bottom_x, above.bottom_y, above.bottom, ContactKind::kAtMost});
            return;
        }
        const auto& [lower, rank_below] = logged_[cut];
        const Interval& below = *lower;
        const double gap = below.from - (above.from + above.length);
        if (rank_below > rank_above + 1 && gap > kMostGap * std::min(above.length, below.length)) {
            // Units between them may lie where nothing was logged.
            contacts.push_back({above.bottom_x, above.bottom_y, above.bottom, ContactKind::kAtMost});
            contacts.push_back({below.x, below.y, below.top, ContactKind::kAtLeast});
        } else {
            contacts.push_back({(above.bottom_x + below.x) / 2, (above.bottom_y + below.y) / 2,
                                (above.bottom + below.top) / 2, ContactKind::kAt});
        }
    }

    double logged_length() const {
        double sum = 0;
        for (const Logged& one : logged_) sum += one.interval->length;
        return sum;
    }

    /// The length in its own unit.
    double ordered_length(std::size_t unit_count) const {
        double sum = 0;
        std::size_t at = 0;
        for (std::uint32_t rank = 0; rank < unit_count; ++rank) {
            const std::size_t end = rank + 1 < unit_count ? cut_of(rank) : logged_.size();
            for (; at < end; ++at)
                if (logged_[at].rank == rank) sum += logged_[at].interval->length;
        }
        return sum;
    }

private:
    struct Logged {
        const Interval* interval;
        std::uint32_t rank;
    };

    /// The number of intervals above the base of unit `rank`: where the length of younger units above and older ones
    /// below is largest.
    std::size_t cut_of(std::uint32_t rank) const {
        double length = 0, most = 0;
        std::size_t cut = 0;
        for (std::size_t n = 0; n < logged_.size(); ++n) {
            length += logged_[n].rank <= rank ? logged_[n].interval->length : -logged_[n].interval->length;
            if (length > most) most = length, cut = n + 1;
        }
        return cut;
    }

    std::vector<Logged> logged_;
    bool starts_at_ground_ = false;
};

/// The order of intervals along a hole is that of the units only on the way down.
void require_downward(const Hole& hole, const DrillHoles& table) {
    const double top = hole.front()->top, end = hole.back()->bottom;
    if (end > top)
        fail(table.path, fmt::format("row {}: hole '{}' leads upwards, from {} to {}; --layers takes holes drilled "
                                     "downwards from the ground, leave it out",
                                     hole.front()->row, shown(table.holes.text(hole.front()->hole)), top, end));
}

}  // namespace

LayerOrder order_layers(const DrillHoles& table, const TableLabels& labels, const std::string& wanted) {
    const std::vector<Hole> holes = holes_of(table);
    LayerOrder order;
    order.units = WantedUnits(table, labels).find(wanted, holes);
    std::vector<std::uint32_t> rank_of(labels.count(), kNoUnit);
    for (std::uint32_t n = 0; n < order.units.size(); ++n) rank_of[order.units[n]] = n;
    order.contacts.resize(order.units.size() - 1);
    double logged = 0, ordered = 0;
    for (const Hole& hole : holes) {
        require_downward(hole, table);
        const HoleContacts found(hole, rank_of);
        if (found.is_empty()) continue;
        logged += found.logged_length();
        ordered += found.ordered_length(order.units.size());
        for (std::uint32_t rank = 0; rank < order.contacts.size(); ++rank)
            found.append_contacts(rank, order.contacts[rank]);
    }
    if (logged > 0) order.ordered_share = ordered / logged;
    if (order.ordered_share < kLeastOrder)
        fail(table.path,
             fmt::format("only {:.0f} % of the logged length is in the order of --layers; units that repeat "
                         "in a hole are no layers, leave out --layers or give another order",
                         100 * order.ordered_share));
    return order;
}

}  // namespace regionmesh::formats
