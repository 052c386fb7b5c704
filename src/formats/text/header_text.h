// Words and numbers in the text headers of volumes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh::formats {

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);  // ASCII letters

/// What stands between blanks, or between any of `separators`.
std::vector<std::string_view> split_words(std::string_view text, std::string_view separators = " \t\r\n\v\f");

/// The whole of `text` as a number, nothing around it but a plus sign in front. No infinities; NaN only where it is
/// written as such.
std::optional<double> parse_real(std::string_view text);
std::optional<std::int64_t> parse_integer(std::string_view text);
std::optional<std::uint64_t> parse_size(std::string_view text);

/// Several of them between blanks; nothing where one is no number.
std::optional<std::vector<double>> parse_reals(std::string_view text);
std::optional<std::vector<std::uint64_t>> parse_sizes(std::string_view text);

/// Takes the first line off `text`, without its end.
std::string_view take_line(std::string_view& text);

/// As much of a word or line of a file as an error shows.
std::string shown(std::string_view text);

/// A name as files give it, trimmed, as one line of UTF-8: what is none is taken as Latin-1.
std::string one_line(std::string_view text);

}  // namespace regionmesh::formats
