#include <algorithm>
#include <optional>
#include <set>

#include "formats/surface/file_surface.h"
#include "formats/text/header_text.h"
#include "regionmesh/label_table.h"

namespace regionmesh {
namespace {

using Labels = std::array<InputLabel, 2>;

/// The labels that a group name contains, and the name of the first.
struct NamedLabels {
    Labels labels;
    std::string name;
    bool is_unsigned = false;  // a label is 2^63 or more
};

/// Labels of 2^63 and more are negative as signed numbers.
bool is_large(std::string_view text, InputLabel label) { return label < 0 && !text.starts_with('-'); }

/// The label in "region_3" or "region_3 liver".
std::optional<InputLabel> region_in(std::string_view name) {
    std::string_view word = formats::take_word(name);
    if (!word.starts_with("region_")) return std::nullopt;
    word.remove_prefix(7);
    return formats::parse_label(word);
}

/// The exterior of a file that does not name it. If a region has the usual label, it is
/// LabelTable::exterior_label(), as in the model that was written.
InputLabel exterior_of(const std::vector<std::string>& names, InputLabel exterior) {
    LabelTable labels;
    bool is_taken = false;
    for (const std::string& name : names) {
        const auto label = region_in(name);
        if (!label) continue;
        is_taken = is_taken || *label == exterior;
        labels.dense(*label);
    }
    return is_taken ? labels.exterior_label() : exterior;
}

std::optional<NamedLabels> labels_in(std::string_view name, InputLabel exterior) {
    std::string_view rest = name;
    std::string_view word = formats::take_word(rest);
    if (word.starts_with("interface_")) {
        word.remove_prefix(10);
        const std::size_t cut = word.find('_');
        if (cut == std::string_view::npos) return std::nullopt;
        const std::string_view one = word.substr(0, cut), other = word.substr(cut + 1);
        const auto first = formats::parse_label(one), second = formats::parse_label(other);
        if (!first || !second) return std::nullopt;
        return NamedLabels{{*first, *second}, {}, is_large(one, *first) || is_large(other, *second)};
    }
    if (word.starts_with("region_")) word.remove_prefix(7);
    const auto label = formats::parse_label(word);
    if (!label || *label == exterior) return std::nullopt;
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    return NamedLabels{{*label, exterior}, std::string(rest), is_large(word, *label)};
}

}  // namespace

std::uint32_t RegionGroups::add(const std::string& name, bool is_apart) {
    if (!is_apart && !name.empty()) {
        const auto [at, is_new] = numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
        if (!is_new) return at->second;
    }
    names_.push_back(name);
    return static_cast<std::uint32_t>(names_.size() - 1);
}

void RegionGroups::put_labels(FileSurface& surface) const {
    surface.exterior_label = exterior_of(names_, surface.exterior_label);
    std::vector<Labels> labels(names_.size());
    std::vector<bool> is_used(names_.size()), is_told(names_.size());
    for (const Labels& face : surface.labels) is_used[static_cast<std::size_t>(face[0])] = true;
    std::set<InputLabel> taken{surface.exterior_label};
    for (std::size_t n = 0; n < names_.size(); ++n) {
        const auto told = labels_in(names_[n], surface.exterior_label);
        if (!told) continue;
        is_told[n] = true;
        labels[n] = told->labels;
        surface.is_unsigned |= told->is_unsigned;
        taken.insert(told->labels.begin(), told->labels.end());
        if (!told->name.empty()) surface.names.try_emplace(told->labels[0], told->name);
    }
    InputLabel next = 1;
    for (std::size_t n = 0; n < names_.size(); ++n) {
        if (is_told[n] || !is_used[n]) continue;
        while (taken.contains(next)) ++next;
        labels[n] = {next, surface.exterior_label};
        if (!names_[n].empty()) surface.names.try_emplace(next, names_[n]);
        ++next;
    }
    for (Labels& face : surface.labels) face = labels[static_cast<std::size_t>(face[0])];
}

}  // namespace regionmesh
