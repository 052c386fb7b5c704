// Writes lines of words and numbers; reals round-trip.
#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

#include "regionmesh/output_file.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Reals get the fewest digits that give the same double when read. Writes a megabyte at a time; call flush() at the
/// end.
class TextWriter {
public:
    explicit TextWriter(OutputFile& file) : file_(file) { text_.reserve(kBufferBytes + 4096); }
    TextWriter(const TextWriter&) = delete;
    TextWriter& operator=(const TextWriter&) = delete;

    /// Writes the words with a space between each two, and a newline.
    template <class First, class... Rest>
    void line(const First& first, const Rest&... rest) {
        put(first);
        ((text_ += ' ', put(rest)), ...);
        end_line();
    }
    /// Writes the words without spaces or newline.
    template <class... Words>
    void add(const Words&... words) {
        (put(words), ...);
    }
    void end_line() {
        text_ += '\n';
        if (text_.size() >= kBufferBytes) flush();
    }
    void flush() {
        file_.write(text_);
        text_.clear();
    }

private:
    static constexpr std::size_t kBufferBytes = 1 << 20;

    void put(std::string_view word) { text_ += word; }
    void put(char letter) { text_ += letter; }
    template <class T>
    requires std::integral<T> || std::floating_point<T>
    void put(T number) {
        char digits[32];
        text_.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
    }
    void put(Vec3 p) { put(p.x), text_ += ' ', put(p.y), text_ += ' ', put(p.z); }

    OutputFile& file_;
    std::string text_;
};

}  // namespace regionmesh
