#include "formats/text/header_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "formats/codec/byte_reader.h"

namespace regionmesh::formats {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

template <class Number>
std::optional<std::vector<Number>> parse_all(std::string_view text, std::optional<Number> (*parse)(std::string_view)) {
    std::vector<Number> numbers;
    for (const std::string_view word : split_words(text)) {
        const auto number = parse(word);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Length in bytes of the UTF-8 character at the front of `text`; 0 where there is none.
std::size_t utf8_length(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xC2 && lead < 0xE0 ? 2 : lead >= 0xE0 && lead < 0xF0 ? 3 : 4;
    if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || text.size() < length) return 0;
    if (!std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), is_continuation)) return 0;
    // After these leads, other second bytes make a character too long, a surrogate, or one beyond U+10FFFF.
    const auto second = static_cast<unsigned char>(length > 1 ? text[1] : 0);
    const bool is_good = lead == 0xE0   ? second >= 0xA0
                         : lead == 0xED ? second < 0xA0
                         : lead == 0xF0 ? second >= 0x90
                         : lead == 0xF4 ? second < 0x90
                                        : true;
    return is_good ? length : 0;
}

/// Bytes that are no UTF-8 are read as Latin-1.
std::string in_utf8(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const auto byte = static_cast<unsigned char>(text[0]);
        if (length == 0) {
            result += static_cast<char>(0xC0 | byte >> 6);
            result += static_cast<char>(0x80 | (byte & 0x3F));
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

}  // namespace

std::string_view trim(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

std::vector<std::string_view> split_words(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> words;
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
        if (text.empty()) return words;
        words.push_back(text.substr(0, text.find_first_of(separators)));
        text.remove_prefix(words.back().size());
    }
}

std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    line.remove_prefix(word.size());
    return word;
}

std::optional<double> parse_real(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument || std::isinf(number))
        return std::nullopt;
    if (error == std::errc{}) return number;
    const std::size_t power = text.find_first_of("eE");
    const bool is_tiny = power != std::string_view::npos && text.substr(power + 1, 1) == "-";
    return is_tiny ? std::optional(0.0) : std::nullopt;
}

std::optional<double> parse_finite(std::string_view text) {
    const auto number = parse_real(text);
    return number && std::isnan(*number) ? std::nullopt : number;
}

std::optional<std::int64_t> parse_label(std::string_view text) {
    if (const auto number = parse_integer(text)) return number;
    const auto bits = parse_size(text);
    return bits ? std::optional(static_cast<std::int64_t>(*bits)) : std::nullopt;
}

std::optional<std::uint8_t> parse_byte(std::string_view text) {
    const auto number = parse_integer(text);
    if (!number || *number < 0 || *number > 255) return {};
    return static_cast<std::uint8_t>(*number);
}

std::optional<std::uint32_t> parse_colour(std::string_view text) {
    if (text.starts_with('#')) text.remove_prefix(1);
    if (text.size() != 6) return {};
    std::uint32_t colour = 0;
    for (const char letter : text) {
        if (!std::isxdigit(static_cast<unsigned char>(letter))) return {};
        colour = colour << 4 | static_cast<std::uint32_t>(letter <= '9' ? letter - '0' : (letter | 32) - 'a' + 10);
    }
    return colour;
}

std::optional<std::int64_t> parse_table_label(std::string_view text) {
    const std::size_t point = text.find('.');
    if (point != std::string_view::npos && point > 0 &&
        text.find_first_not_of('0', point + 1) == std::string_view::npos)
        text = text.substr(0, point);
    return parse_label(text);
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return parse_whole<std::int64_t>(text); }
std::optional<std::uint64_t> parse_size(std::string_view text) { return parse_whole<std::uint64_t>(text); }

std::optional<std::vector<double>> parse_reals(std::string_view text) { return parse_all(text, parse_real); }
std::optional<std::vector<std::uint64_t>> parse_sizes(std::string_view text) { return parse_all(text, parse_size); }

std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::string shown(std::string_view text) {
    constexpr std::size_t kMost = 40;
    std::size_t end = std::min(kMost, text.size());
    while (end < text.size() && end + 4 > kMost && is_continuation(text[end])) --end;  // not within a character
    return in_utf8(text.substr(0, end)) + (end < text.size() ? "..." : "");
}

std::string one_line(std::string_view text) {
    std::string name = in_utf8(trim(text));
    for (char& c : name)
        if ((c >= 0 && c < ' ') || c == 0x7F) c = ' ';
    return name;
}

}  // namespace regionmesh::formats
