#include "boreholes/table_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/add_warning.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

bool is_whole_number(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// None where a text is a word. Throws Error(kInput) for whole numbers that no type of 64 bits holds.
std::optional<std::vector<InputLabel>> numbers_of(const std::filesystem::path& path, const TextTable& texts,
                                                  bool& is_unsigned) {
    constexpr std::string_view kWanted = "labels are whole numbers from -2^63 to 2^63 - 1, or from 0 to 2^64 - 1";
    std::vector<InputLabel> labels(texts.size());
    bool has_negative = false, has_large = false;
    std::optional<std::uint32_t> too_large;
    for (std::uint32_t i = 0; i < texts.size(); ++i) {
        const auto label = parse_table_label(texts.text(i));
        if (!label && !is_whole_number(texts.text(i))) return std::nullopt;
        if (!label) too_large = i;
        labels[i] = label.value_or(0);
        (texts.text(i).starts_with('-') ? has_negative : has_large) |= labels[i] < 0;
    }
    if (too_large) fail(path, fmt::format("label '{}': {}", shown(texts.text(*too_large)), kWanted));
    if (has_negative && has_large) fail(path, fmt::format("has negative labels and some of 2^63 or more: {}", kWanted));
    is_unsigned = has_large;
    return labels;
}

/// The rank of each text in byte order, from 1.
std::vector<InputLabel> ranks_of(const TextTable& texts) {
    std::vector<std::uint32_t> order(texts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return texts.text(a) < texts.text(b); });
    std::vector<InputLabel> labels(texts.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) labels[order[i]] = InputLabel{i} + 1;
    return labels;
}

}  // namespace

std::uint32_t TextTable::number_of(std::string_view text) {
    if (!texts_.empty() && *texts_[last_] == text) return last_;
    auto place = numbers_.find(text);
    if (place == numbers_.end()) {
        place = numbers_.emplace(text, size()).first;
        texts_.push_back(&place->first);
    }
    return last_ = place->second;
}

std::uint32_t TableLabels::add(std::string_view text, std::string_view name, std::uint32_t row) {
    const std::uint32_t number = texts_.number_of(text);
    if (name.empty()) return number;
    if (number >= names_.size()) names_.resize(number + std::size_t{1});
    Name& known = names_[number];
    if (known.text.empty()) {
        known = {std::string(name), row};
    } else if (known.text != name) {
        refuse_names(number, known, {std::string(name), row});
    }
    return number;
}

bool TableLabels::are_words() const {
    bool is_unsigned = false;
    return !numbers_of(path_, texts_, is_unsigned);
}

std::vector<InputLabel> TableLabels::labels(TetrahedraInfo& info) const {
    auto numbers = numbers_of(path_, texts_, info.is_unsigned);
    const bool are_words = !numbers;
    const std::vector<InputLabel> labels = are_words ? ranks_of(texts_) : std::move(*numbers);
    if (are_words) add_warning(info.warning, warning_of_numbers());
    std::unordered_map<InputLabel, const Name*> named;  // several texts may be the same number
    for (std::uint32_t i = 0; i < names_.size(); ++i) {
        if (names_[i].text.empty()) continue;
        const auto [place, is_new] = named.emplace(labels[i], &names_[i]);
        if (!is_new && place->second->text != names_[i].text) refuse_names(i, *place->second, names_[i]);
        info.names.emplace(labels[i], one_line(names_[i].text));
    }
    for (std::uint32_t i = 0; are_words && i < texts_.size(); ++i)
        info.names.emplace(labels[i], one_line(texts_.text(i)));  // unless the label has a name
    return labels;
}

/// A warning about labels that are words: empty where none is a number.
std::string TableLabels::warning_of_numbers() const {
    std::optional<std::uint32_t> number, word;
    for (std::uint32_t i = 0; i < texts_.size() && !(number && word); ++i) {
        std::optional<std::uint32_t>& first = parse_table_label(texts_.text(i)) ? number : word;
        if (!first) first = i;
    }
    if (!number || !word) return {};
    return fmt::format("label '{}' is a whole number and '{}' is none; all labels are taken as words",
                       shown(texts_.text(*number)), shown(texts_.text(*word)));
}

void TableLabels::refuse_names(std::uint32_t label, const Name& a, const Name& b) const {
    fail(path_, fmt::format("rows {} and {}: label '{}' is called '{}' and '{}'; keep one name", std::min(a.row, b.row),
                            std::max(a.row, b.row), shown(texts_.text(label)), shown(a.row < b.row ? a.text : b.text),
                            shown(a.row < b.row ? b.text : a.text)));
}

}  // namespace regionmesh::formats
