// The numbers of a Gmsh mesh, from text or binary files.
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "formats/codec/byte_reader.h"

namespace regionmesh::formats {

/// A place in a file.
struct MshPlace {
    std::uint64_t byte = 0, lines = 0;
};

/// Reads MSH 2.0 to 2.2 and 4.1, in binary of either byte order. Throws Error(kInput) that names the file and the line
/// or byte.
class MshStream {
public:
    /// Reads $MeshFormat. Throws for other versions and other files.
    explicit MshStream(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return reader_.path(); }
    bool is_version_4() const { return is_version_4_; }
    bool is_binary() const { return is_binary_; }

    /// The name of the next section, without '$'; its contents follow.
    std::optional<std::string> next_section();
    void skip_section(const std::string& name);
    /// Requires the end of the section.
    void end_section(const std::string& name);

    MshPlace place() const { return {reader_.place(), reader_.lines()}; }
    void go_to(MshPlace place) { reader_.go_to(place.byte, place.lines); }

    std::int64_t integer();
    /// A count, or the number of a node or an element.
    std::uint64_t size();
    double real();
    /// The number of nodes or elements in MSH 2: a line of text, also in binary files.
    std::uint64_t count_line();

    /// Parts that are text also in binary files.
    std::int64_t text_integer();
    std::string_view text_word();
    std::string_view line();

    [[noreturn]] void fail(const std::string& text) const;

private:
    template <class Number>
    Number binary() {
        return reader_.take_number<Number>(is_big_endian_);
    }

    ByteReader reader_;
    bool is_in_line_ = false;  // a word was taken, but not its line end
    bool is_version_4_ = false;
    bool is_binary_ = false;
    bool is_big_endian_ = false;
};

}  // namespace regionmesh::formats
