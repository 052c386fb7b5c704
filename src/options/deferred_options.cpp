#include "options/deferred_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/text/length_unit.h"
#include "options/option_values.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

bool takes_labels(const OptionSpec& option) {
    return option.name == "labels" || (option.kind == OptionKind::kLabel && option.repeats);
}

/// The parts between commas. One that is no label and no range of labels is a name.
std::vector<std::string> parts_of(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

bool is_name(const std::string& part) {
    const auto is_letter = [](unsigned char c) { return c >= 0x80 || std::isalpha(c) != 0; };
    return !part.empty() && is_letter(static_cast<unsigned char>(part.front()));
}

/// "0.5mm" as 0.5 and metres in a millimetre; none for a text of another form.
std::optional<std::pair<double, double>> length_in(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    while (unit.starts_with(' ')) unit.remove_prefix(1);
    if (error != std::errc{} || unit.empty()) return std::nullopt;
    if (const auto metres = formats::metres_in(unit)) return std::pair(number, *metres);
    return std::nullopt;
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// "3,7": the labels that have the name.
std::string labels_named(const std::string& name, const LabelNames& names) {
    std::string labels;
    for (const auto& [label, own] : names)
        if (lower(own) == lower(name)) labels += (labels.empty() ? "" : ",") + std::to_string(label);
    return labels;
}

std::string with_labels(const OptionSpec& option, const std::string& text, const LabelNames& names,
                        const std::string& source) {
    std::string resolved;
    for (const std::string& part : parts_of(text)) {
        const std::string labels = is_name(part) ? labels_named(part, names) : part;
        if (labels.empty())
            throw Error(ErrorCode::kUsage,
                        fmt::format("{} {}: {}; regionmesh info lists its labels", option.flag(), part,
                                    names.empty() ? source + " has no names: give labels, or --names TABLE"
                                                  : source + " has no label of that name"));
        resolved += (resolved.empty() ? "" : ",") + labels;
    }
    return resolved;
}

}  // namespace

bool is_deferred(const OptionSpec& option, const std::string& text) {
    if (takes_labels(option)) return std::ranges::any_of(parts_of(text), is_name);
    return option.kind == OptionKind::kNumber && option.unit == "length" && length_in(text);
}

void resolve_options(Settings& settings, const LabelNames& names, std::optional<double> metres,
                     const std::string& source) {
    if (settings.metres) metres = settings.metres;
    const bool has_named_background =
        std::ranges::any_of(settings.deferred, [](const auto& value) { return value.first == "background"; });
    if (has_named_background) settings.reconstruct.background.clear();
    const OptionValues deferred = std::exchange(settings.deferred, {});
    for (const auto& [name, text] : has_named_background ? settings.given : deferred) {
        const OptionSpec& option = *find_option(name);
        if (!is_deferred(option, text) && name != "background") continue;
        if (takes_labels(option)) {
            option.set(settings, with_labels(option, text, names, source));
            continue;
        }
        if (!metres)
            throw Error(ErrorCode::kUsage,
                        fmt::format("{} {}: {} does not say its unit of length; give --units, or a number without unit",
                                    option.flag(), text, source));
        const auto [number, own] = *length_in(text);
        option.set(settings, number_text(number * (own / *metres)));
    }
}

}  // namespace regionmesh
