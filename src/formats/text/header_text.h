// Words and numbers in text: headers, tables, and lines of text files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh::formats {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // of UTF-8

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);  // ASCII letters

/// The words between blanks, or between any of `separators`.
std::vector<std::string_view> split_words(std::string_view text, std::string_view separators = " \t\r\n\v\f");

/// Takes the first word off a line; empty at its end.
std::string_view take_word(std::string_view& line);

/// All of `text` as a number, with or without a plus sign in front; none for any other text. Reals too small for a
/// double are 0. "nan" is a real, infinities are not.
std::optional<double> parse_real(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_size(std::string_view text);

/// A real, but not NaN.
std::optional<double> parse_finite(std::string_view text);
/// A whole number; above 2^63 - 1 the bits of an unsigned one.
std::optional<std::int64_t> parse_label(std::string_view text);
/// A whole number from 0 to 255, as of red, green, blue or alpha.
std::optional<std::uint8_t> parse_byte(std::string_view text);
/// "#RRGGBB", with or without '#'.
std::optional<std::uint32_t> parse_colour(std::string_view text);
/// A label in a table: programs without missing integers write "3.0".
std::optional<std::int64_t> parse_table_label(std::string_view text);

/// Several numbers between blanks; none where one of the words is no number.
std::optional<std::vector<double>> parse_reals(std::string_view text);
std::optional<std::vector<std::uint64_t>> parse_sizes(std::string_view text);

/// Takes the first line off `text`; returns it without its line end.
std::string_view take_line(std::string_view& text);

/// The beginning of a word or line of a file, for messages, in UTF-8 as one_line() has it.
std::string shown(std::string_view text);

/// A name from a file, trimmed, as one line of UTF-8. Bytes that are no UTF-8 are read as Latin-1.
std::string one_line(std::string_view text);

}  // namespace regionmesh::formats
