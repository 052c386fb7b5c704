#include "formats/codec/byte_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <span>

namespace regionmesh::formats {
namespace {

constexpr std::size_t kChunk = 1 << 20, kLongestLine = 1 << 24;
constexpr std::string_view kSpaces = " \t\r\n\v\f";

}  // namespace

/// Reads on; false at the end of the file.
bool ByteReader::fill() {
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    if (end_ == buffer_.size()) buffer_.resize(std::max(kChunk, 2 * buffer_.size()));
    const std::size_t count =
        file_.read(offset_, std::as_writable_bytes(std::span(buffer_.data() + end_, buffer_.size() - end_)));
    end_ += count;
    offset_ += count;
    return count > 0;
}

void ByteReader::drop(std::size_t count) {
    begin_ += count;
    taken_ += count;
}

std::string_view ByteReader::peek(std::size_t count) {
    while (end_ - begin_ < count)
        if (!fill()) fail("ends too early: it was cut short");
    return held().substr(0, count);
}

std::string_view ByteReader::take(std::size_t count) {
    const std::string_view bytes = peek(count);
    drop(count);
    return bytes;
}

std::optional<std::string_view> ByteReader::take_line() {
    std::size_t size = held().find('\n');
    for (std::size_t seen = 0; size == std::string_view::npos; size = held().find('\n', seen)) {
        seen = held().size();
        if (seen >= kLongestLine) fail_line("is longer than a line of such a file can be");
        if (fill()) continue;
        if (seen == 0) return std::nullopt;
        const std::string_view last = held();
        drop(seen);
        ++lines_;
        return last;
    }
    std::string_view line = held().substr(0, size);
    drop(size + 1);
    ++lines_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::optional<std::string_view> ByteReader::take_word() {
    for (;;) {
        const std::string_view bytes = held();
        const std::size_t first = std::min(bytes.find_first_not_of(kSpaces), bytes.size());
        lines_ += static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.begin() + first, '\n'));
        drop(first);
        if (first < bytes.size()) break;
        if (!fill()) return std::nullopt;
    }
    std::size_t size = held().find_first_of(kSpaces);
    while (size == std::string_view::npos) {
        const std::size_t seen = held().size();
        if (seen >= kLongestLine) fail_line("holds a word that is too long");
        if (!fill()) {
            size = seen;
            break;
        }
        size = held().find_first_of(kSpaces, seen);
    }
    const std::string_view word = held().substr(0, size);
    drop(size);
    return word;
}

bool ByteReader::skip_past(std::string_view text) {
    for (;;) {
        const std::string_view bytes = held();
        const std::size_t found = bytes.find(text);
        const bool is_found = found != std::string_view::npos;
        const std::size_t kept = std::min(bytes.size(), text.size() - 1);  // the text may begin here and go on
        const std::size_t passed = is_found ? found + text.size() : bytes.size() - kept;
        lines_ += static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.begin() + passed, '\n'));
        drop(passed);
        if (is_found) return true;
        if (!fill()) return false;
    }
}

void ByteReader::go_to(std::uint64_t place, std::uint64_t lines) {
    begin_ = end_ = 0;
    offset_ = taken_ = place;
    lines_ = lines;
}

void ByteReader::fail(const std::string& text) const { formats::fail(path(), text); }

void ByteReader::fail_line(const std::string& text) const {
    formats::fail(path(), "line " + std::to_string(lines_) + ": " + text);
}

std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpaces), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kSpaces));
    line.remove_prefix(word.size());
    return word;
}

std::optional<double> to_real(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    // Numbers that are too small for a double are as good as none.
    if (error == std::errc::result_out_of_range) {
        const std::size_t power = word.find_first_of("eE");
        if (power == std::string_view::npos || word.substr(power + 1, 1) != "-") return std::nullopt;
        value = 0;
    } else if (error != std::errc{}) {
        return std::nullopt;
    }
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const char* const last = word.data() + word.size();
    std::int64_t value = 0;
    auto result = std::from_chars(word.data(), last, value);
    if (result.ec == std::errc::result_out_of_range) {
        std::uint64_t bits = 0;
        result = std::from_chars(word.data(), last, bits);
        value = static_cast<std::int64_t>(bits);
    }
    return result.ec == std::errc{} && result.ptr == last ? std::optional(value) : std::nullopt;
}

}  // namespace regionmesh::formats
