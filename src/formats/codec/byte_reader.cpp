#include "formats/codec/byte_reader.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kChunk = 1 << 20, kLongestLine = 1 << 24;

}  // namespace

ByteReader::ByteReader(InputFile file, std::uint64_t begin, std::uint64_t end, std::string_view separators)
    : file_(std::move(file)),
      bytes_end_(std::min(end, file_.size())),
      offset_(std::min(begin, bytes_end_)),
      taken_(offset_) {
    for (const char c : separators) separates_[static_cast<unsigned char>(c)] = true;
}

/// Reads on; false at the end of the file.
bool ByteReader::fill() {
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
    }
    if (end_ == buffer_.size()) buffer_.resize(std::max(kChunk, 2 * buffer_.size()));
    const std::size_t wanted = std::min<std::uint64_t>(buffer_.size() - end_, bytes_end_ - offset_);
    const std::size_t count = file_.read(offset_, std::as_writable_bytes(std::span(buffer_.data() + end_, wanted)));
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

void ByteReader::require_line_ends(std::string_view line) const {
    if (trim(line).find('\r') != std::string_view::npos)
        fail_line("has carriage returns within a line; write the file with LF or CR LF as line ends");
}

std::optional<std::string_view> ByteReader::take_word() {
    const auto separates = [&](std::size_t at) { return separates_[static_cast<unsigned char>(buffer_[at])]; };
    for (;; drop(1)) {
        if (begin_ == end_ && !fill()) return std::nullopt;
        if (!separates(begin_)) break;
        lines_ += buffer_[begin_] == '\n';
    }
    std::size_t size = 1;
    for (;; ++size) {
        if (size >= kLongestLine) fail_line("holds a word that is too long");
        if (begin_ + size == end_ && !fill()) break;
        if (separates(begin_ + size)) break;
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

}  // namespace regionmesh::formats
