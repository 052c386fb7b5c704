// A file read from its beginning to its end, as bytes, lines or words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "formats/input_file.h"

namespace regionmesh::formats {

/// Holds a megabyte at a time, or the longest line where that is more. What it hands out is good until the next call.
class ByteReader {
public:
    /// Throws Error(kInput) as InputFile does.
    explicit ByteReader(const std::filesystem::path& path) : file_(path) {}

    const std::filesystem::path& path() const { return file_.path(); }
    std::uint64_t size() const { return file_.size(); }
    /// Bytes not yet taken.
    std::uint64_t left() const { return file_.size() - taken_; }

    /// The next `count` bytes, at most a megabyte. Throws where the file ends before.
    std::string_view take(std::size_t count);
    /// The same, which stay to be taken.
    std::string_view peek(std::size_t count);
    /// The next line, without what ends it (LF or CR LF); none at the end of the file. Throws for one of 16 MiB and
    /// more.
    std::optional<std::string_view> take_line();
    /// The next run of bytes between spaces and ends of lines; none at the end of the file.
    std::optional<std::string_view> take_word();

    /// Goes behind the next place where `text` stands; false, and to the end of the file, where it stands nowhere.
    bool skip_past(std::string_view text);

    /// The byte that is taken next, and back or on to one, with the ends of lines before it.
    std::uint64_t place() const { return taken_; }
    void go_to(std::uint64_t place, std::uint64_t lines);

    /// Ends of lines taken so far.
    std::uint64_t lines() const { return lines_; }
    /// Throws Error(kInput) "path: text", and with "line 7: " before the text where lines or words were taken.
    [[noreturn]] void fail(const std::string& text) const;
    [[noreturn]] void fail_line(const std::string& text) const;

private:
    bool fill();
    std::string_view held() const { return std::string_view(buffer_).substr(begin_, end_ - begin_); }
    void drop(std::size_t count);

    InputFile file_;
    std::string buffer_;
    std::size_t begin_ = 0, end_ = 0;
    std::uint64_t offset_ = 0, taken_ = 0, lines_ = 0;
};

/// Takes the first word off a line; empty at its end.
std::string_view take_word(std::string_view& line);

/// A finite number, with a sign or without; none where the word is not one as a whole.
std::optional<double> to_real(std::string_view word);
/// An integer of 64 bits; above 2^63 - 1 the bits of an unsigned one.
std::optional<std::int64_t> to_integer(std::string_view word);

}  // namespace regionmesh::formats
