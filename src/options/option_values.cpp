#include "options/option_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

constexpr double kMostSamplesAlongAnAxis = 0x7FFFFFFF;

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    for (char c : text) {
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// A finite number at the start of `text`; the rest goes to `unit`.
bool parse_leading(const std::string& text, double& number, std::string& unit) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    unit.assign(end, text.data() + text.size());
    return error == std::errc{} && std::isfinite(number);
}

template <class Integer>
bool parse_whole(const std::string& text, Integer& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

struct ParsedLabel {
    InputLabel value = 0;
    bool is_large = false;  // 2^63 or more: `value` has the bits of an unsigned number
};

std::optional<ParsedLabel> label_in(const std::string& text) {
    InputLabel label = 0;
    std::uint64_t bits = 0;
    if (parse_whole(text, label)) return ParsedLabel{label, false};
    if (parse_whole(text, bits)) return ParsedLabel{static_cast<InputLabel>(bits), true};
    return std::nullopt;
}

/// Ranges of "A:B,A:B,A:B" along x, y and z, as typed; either end may be empty. None for a text of another form.
std::optional<std::array<std::pair<std::string, std::string>, 3>> ends_of_ranges(const std::string& text) {
    const std::vector<std::string> parts = split(text);
    if (parts.size() != 3) return std::nullopt;
    std::array<std::pair<std::string, std::string>, 3> ends;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t colon = parts[axis].find(':');
        if (colon == std::string::npos) return std::nullopt;
        ends[axis] = {parts[axis].substr(0, colon), parts[axis].substr(colon + 1)};
    }
    return ends;
}

}  // namespace

std::string Range::text() const {
    if (std::isfinite(high)) return fmt::format("{:.15g} to {:.15g}", low, high);
    return fmt::format("{} {:.15g}", is_low_included ? "at least" : "above", low);
}

void refuse_value(const std::string& flag, const std::string& text, const std::string& wanted) {
    throw Error(ErrorCode::kUsage, fmt::format("{} {}: not {}", flag, text, wanted));
}

std::uint64_t parse_count(const std::string& flag, const std::string& text, const Range& range) {
    std::uint64_t value = 0;
    if (!parse_whole(text, value) || !range.contains(static_cast<double>(value)))
        refuse_value(flag, text, "a whole number of " + range.text());
    return value;
}

double parse_number(const std::string& flag, const std::string& text, const Range& range) {
    double value = 0;
    std::string unit;
    if (!parse_leading(text, value, unit) || !unit.empty() || !range.contains(value))
        refuse_value(flag, text, "a number of " + range.text());
    return value;
}

double parse_share(const std::string& flag, const std::string& text) {
    double value = 0;
    std::string unit;
    const bool is_number = parse_leading(text, value, unit);
    if (unit == "%") value /= 100;
    if (!is_number || (unit != "%" && !unit.empty()) || !(value >= 0 && value <= 1))
        refuse_value(flag, text, "a share, such as 90% or 0.9");
    return value;
}

std::uint64_t parse_bytes(const std::string& flag, const std::string& text) {
    double value = 0;
    std::string unit;
    const bool is_number = parse_leading(text, value, unit);
    constexpr std::pair<const char*, double> kUnits[] = {
        {"", 1}, {"B", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}};
    for (const auto& [name, factor] : kUnits)
        if (is_number && unit == name && value > 0 && value * factor < 0x1p62)
            return static_cast<std::uint64_t>(value * factor);
    refuse_value(flag, text, "a size, such as 500MiB or 2GiB");
}

InputLabel parse_label(const std::string& flag, const std::string& text) {
    if (const auto label = label_in(text)) return label->value;
    refuse_value(flag, text, "a label: a whole number, such as 3");
}

std::vector<std::string> parse_names(const std::string& flag, const std::string& text) {
    std::vector<std::string> names = split(text);
    if (std::ranges::any_of(names, &std::string::empty)) refuse_value(flag, text, "names or labels, as liver,spleen");
    return names;
}

std::vector<double> parse_thresholds(const std::string& flag, const std::string& text) {
    std::vector<double> values;
    for (const std::string& part : split(text)) {
        double value = 0;
        std::string unit;
        if (!parse_leading(part, value, unit) || !unit.empty() || (!values.empty() && !(values.back() < value)))
            refuse_value(flag, text, "numbers that rise, such as 0.5 or 100,300");
        values.push_back(value);
    }
    return values;
}

Vec3 parse_numbers(const std::string& flag, const std::string& text) {
    const auto parts = split(text);
    Vec3 values;
    std::string unit;
    bool is_good = parts.size() == 3;
    for (int axis = 0; is_good && axis < 3; ++axis)
        is_good = parse_leading(parts[axis], values[axis], unit) && unit.empty() && values[axis] > 0;
    if (!is_good) refuse_value(flag, text, "three numbers X,Y,Z above 0");
    return values;
}

std::array<std::uint32_t, 3> parse_counts(const std::string& flag, const std::string& text) {
    const auto parts = split(text);
    std::array<std::uint32_t, 3> values{};
    bool is_good = parts.size() == 3;
    for (int axis = 0; is_good && axis < 3; ++axis)
        is_good = parse_whole(parts[axis], values[axis]) && values[axis] > 0 && values[axis] <= kMostSamplesAlongAnAxis;
    if (!is_good) refuse_value(flag, text, "three whole numbers X,Y,Z from 1");
    return values;
}

std::vector<LabelRange> parse_label_ranges(const std::string& flag, const std::string& text) {
    std::vector<LabelRange> ranges;
    for (const std::string& part : split(text)) {
        const std::size_t dash = part.find('-', 1);  // a minus at the start is a sign
        const bool is_range = dash != std::string::npos;
        const auto first = label_in(part.substr(0, dash));
        const auto last = is_range ? label_in(part.substr(dash + 1)) : first;
        if (!first || !last) refuse_value(flag, text, "labels, such as 1,5-9");
        if (std::pair(first->is_large, first->value) > std::pair(last->is_large, last->value))
            refuse_value(flag, text, fmt::format("a range from low to high: {}", part));
        ranges.push_back({first->value, last->value});
    }
    return ranges;
}

std::array<SampleRange, 3> parse_sample_ranges(const std::string& flag, const std::string& text) {
    const auto refuse = [&] { refuse_value(flag, text, "samples along x, y and z, such as 10:50,:,20:"); };
    const auto ends = ends_of_ranges(text);
    if (!ends) refuse();
    std::array<SampleRange, 3> ranges;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& [first, end] = (*ends)[axis];
        if (!first.empty() && !parse_whole(first, ranges[axis].first)) refuse();
        if (!end.empty() && (!parse_whole(end, ranges[axis].end) || ranges[axis].end <= ranges[axis].first)) refuse();
    }
    return ranges;
}

std::array<LengthRange, 3> parse_length_ranges(const std::string& flag, const std::string& text) {
    const auto refuse = [&] { refuse_value(flag, text, "coordinates along x, y and z, such as 0:120.5,:,-20:35"); };
    const auto ends = ends_of_ranges(text);
    if (!ends) refuse();
    std::array<LengthRange, 3> ranges;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& [low, high] = (*ends)[axis];
        std::string unit;
        if (!low.empty() && (!parse_leading(low, ranges[axis].low, unit) || !unit.empty())) refuse();
        if (!high.empty() && (!parse_leading(high, ranges[axis].high, unit) || !unit.empty())) refuse();
        if (!(ranges[axis].low <= ranges[axis].high)) refuse();
    }
    return ranges;
}

std::array<std::uint32_t, 3> parse_factors(const std::string& flag, const std::string& text) {
    const std::string all = text.find(',') == std::string::npos ? text + ',' + text + ',' + text : text;
    try {
        return parse_counts(flag, all);
    } catch (const Error&) {
        refuse_value(flag, text, "a number of samples, such as 2 or 2,2,1");
    }
}

bool parse_flag(const std::string& flag, const std::string& text) {
    if (text != "true" && text != "false") refuse_value(flag, text, "true or false");
    return text == "true";
}

std::string number_text(double value) { return fmt::format("{}", value); }

std::string bytes_text(std::uint64_t bytes) {
    constexpr std::pair<const char*, int> kUnits[] = {{"GiB", 30}, {"MiB", 20}, {"KiB", 10}};
    for (const auto& [unit, shift] : kUnits)
        if (bytes > 0 && bytes % (std::uint64_t{1} << shift) == 0) return fmt::format("{}{}", bytes >> shift, unit);
    return std::to_string(bytes);
}

}  // namespace regionmesh
