// A file, or a part of it, read from its beginning to its end as bytes, lines or words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "formats/codec/numbers.h"
#include "formats/input_file.h"

namespace regionmesh::formats {

inline constexpr std::string_view kBlanks = " \t\r\n\v\f", kBlanksAndCommas = " \t\r\n\v\f,";

/// Holds a megabyte at a time, or the longest line where that is more. Text that it returns is valid until the next
/// call.
class ByteReader {
public:
    /// Throws Error(kInput) as InputFile does.
    explicit ByteReader(const std::filesystem::path& path) : ByteReader(InputFile(path)) {}
    /// Reads the bytes from `begin` to `end`, or to the end of the file. Words end at any of
    /// `separators`.
    explicit ByteReader(InputFile file, std::uint64_t begin = 0, std::uint64_t end = UINT64_MAX,
                        std::string_view separators = kBlanks);

    const std::filesystem::path& path() const { return file_.path(); }
    std::uint64_t size() const { return file_.size(); }
    /// Bytes not yet taken.
    std::uint64_t left() const { return bytes_end_ - taken_; }

    /// A number of type T. Throws where the file ends too early.
    template <class T>
    T take_number(bool is_big_endian) {
        return load<T>(take(sizeof(T)).data(), is_big_endian);
    }
    /// The next `count` bytes, at most a megabyte. Throws where the file ends too early.
    std::string_view take(std::size_t count);
    /// The same bytes, without taking them.
    std::string_view peek(std::size_t count);
    /// The next line, without its line end (LF or CR LF); none at the end of the file. Throws for a line of 16 MiB or
    /// more.
    std::optional<std::string_view> take_line();
    /// Throws where a line of text has the line ends of old Macs, which are none here. Those at its end are blanks.
    void require_line_ends(std::string_view line) const;
    /// The next run of bytes between separators; none at the end of the file.
    std::optional<std::string_view> take_word();

    /// Moves behind the next occurrence of `text`; to the end of the file, and false, where there is none.
    bool skip_past(std::string_view text);

    /// The place of the next byte, and a move to a place with the given number of line ends before it.
    std::uint64_t place() const { return taken_; }
    void go_to(std::uint64_t place, std::uint64_t lines);

    /// Line ends taken so far.
    std::uint64_t lines() const { return lines_; }
    /// Throws Error(kInput) "path: text", and "path: line 7: text" with the number of lines taken.
    [[noreturn]] void fail(const std::string& text) const;
    [[noreturn]] void fail_line(const std::string& text) const;

private:
    bool fill();
    std::string_view held() const { return std::string_view(buffer_).substr(begin_, end_ - begin_); }
    void drop(std::size_t count);

    InputFile file_;
    std::string buffer_;
    std::uint64_t bytes_end_;            // in the file
    std::array<bool, 256> separates_{};  // words, by byte
    std::size_t begin_ = 0, end_ = 0;    // in buffer_
    std::uint64_t offset_ = 0, taken_ = 0, lines_ = 0;
};

}  // namespace regionmesh::formats
