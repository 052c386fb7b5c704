// Binds a row of the table of options to a member of Settings: kind, default and set() follow from the member's type.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "options/option_values.h"
#include "regionmesh/options.h"

namespace regionmesh {

/// A value as typed: `text` after `flag`, where `range` is allowed.
struct TypedValue {
    const std::string& flag;
    const std::string& text;
    const Range& range;
};

inline void read_value(const TypedValue& typed, bool& value) { value = parse_flag(typed.flag, typed.text); }
inline void read_value(const TypedValue& typed, double& value) {
    value = parse_number(typed.flag, typed.text, typed.range);
}
inline void read_value(const TypedValue& typed, std::uint64_t& value) {
    value = parse_count(typed.flag, typed.text, typed.range);
}
/// Requires a range within 32 bits.
inline void read_value(const TypedValue& typed, std::uint32_t& value) {
    value = static_cast<std::uint32_t>(parse_count(typed.flag, typed.text, typed.range));
}
inline void read_value(const TypedValue& typed, Vec3& value) { value = parse_numbers(typed.flag, typed.text); }
inline void read_value(const TypedValue& typed, std::array<std::uint32_t, 3>& value) {
    value = parse_counts(typed.flag, typed.text);
}
inline void read_value(const TypedValue& typed, std::string& value) { value = typed.text; }
inline void read_value(const TypedValue& typed, std::vector<std::string>& values) { values.push_back(typed.text); }
template <class T>
void read_value(const TypedValue& typed, std::optional<T>& value) {
    read_value(typed, value.emplace());
}

template <class T>
constexpr OptionKind kKindOf = OptionKind::kText;
template <>
inline constexpr OptionKind kKindOf<bool> = OptionKind::kFlag;
template <>
inline constexpr OptionKind kKindOf<double> = OptionKind::kNumber;
template <>
inline constexpr OptionKind kKindOf<std::uint64_t> = OptionKind::kCount;
template <>
inline constexpr OptionKind kKindOf<std::uint32_t> = OptionKind::kCount;
template <>
inline constexpr OptionKind kKindOf<Vec3> = OptionKind::kNumbers;
template <>
inline constexpr OptionKind kKindOf<std::array<std::uint32_t, 3>> = OptionKind::kCounts;
template <class T>
inline constexpr OptionKind kKindOf<std::optional<T>> = kKindOf<T>;

/// A count with a larger bound is shown without range.
inline constexpr double kLargestShownBound = 1e9;

/// `access` returns a pointer to a member of the Settings& that it gets.
template <class Access>
OptionSpec option(OptionSpec row, Access access, Range range = {}) {
    using Value = std::remove_pointer_t<std::invoke_result_t<Access, Settings&>>;
    row.kind = kKindOf<Value>;
    Settings defaults;
    if constexpr (std::is_same_v<Value, double>) row.default_text = number_text(*access(defaults));
    if constexpr (std::is_same_v<Value, std::uint32_t> || std::is_same_v<Value, std::uint64_t>)
        row.default_text = std::to_string(*access(defaults));
    if (row.kind == OptionKind::kNumber || (row.kind == OptionKind::kCount && range.high <= kLargestShownBound))
        row.range = range.text();
    row.set = [flag = row.flag(), access, range](Settings& settings, const std::string& text) {
        read_value({flag, text, range}, *access(settings));
    };
    return row;
}

/// A flag that sets a bool to false.
template <class Access>
OptionSpec inverted_flag(OptionSpec row, Access access) {
    row.kind = OptionKind::kFlag;
    row.set = [flag = row.flag(), access](Settings& settings, const std::string& text) {
        *access(settings) = !parse_flag(flag, text);
    };
    return row;
}

/// An option whose value is the name of a file. A file to write is not `-`, by which many programs mean standard
/// output.
template <class Access>
OptionSpec file_option(OptionSpec row, Access access) {
    row = option(std::move(row), access);
    row.kind = OptionKind::kFile;
    if (!row.is_output) return row;
    row.set = [flag = row.flag(), set = row.set](Settings& settings, const std::string& text) {
        if (text == "-")
            refuse_value(flag, text,
                         "the name of a file; standard output is /dev/stdout, unless the name needs an extension");
        set(settings, text);
    };
    return row;
}

/// One of `words`, given to `choose(settings, number of the word)`. The first word is the default.
template <class Choose>
OptionSpec word_option(OptionSpec row, std::vector<std::string_view> words, Choose choose) {
    row.kind = OptionKind::kWord;
    row.default_text = words.front();
    row.set = [flag = row.flag(), words, choose](Settings& settings, const std::string& text) {
        std::string list;
        for (std::size_t n = 0; n < words.size(); ++n) {
            if (words[n] == text) return choose(settings, n);
            list += (n == 0 ? "" : ", ") + std::string(words[n]);
        }
        refuse_value(flag, text, "one of " + list);
    };
    row.words = std::move(words);
    return row;
}

/// An option whose absence differs from each of its values.
inline OptionSpec without_default(OptionSpec row) {
    row.default_text.clear();
    return row;
}

/// Any other value: `set` gets the settings, the flag and the text.
template <class Set>
OptionSpec special_option(OptionSpec row, OptionKind kind, Set set) {
    row.kind = kind;
    row.set = [flag = row.flag(), set](Settings& settings, const std::string& text) { set(settings, flag, text); };
    return row;
}

}  // namespace regionmesh
