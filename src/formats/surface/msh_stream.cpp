#include "formats/surface/msh_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr const char* kSaveAgain = "write it as MSH 4.1: gmsh old.msh -save -format msh41 -o new.msh";

}  // namespace

MshStream::MshStream(const std::filesystem::path& path) : reader_(path) {
    const std::size_t start = static_cast<std::size_t>(std::min<std::uint64_t>(reader_.size(), 4));
    if (reader_.peek(start) == "$NOD") formats::fail(path, fmt::format("is MSH 1.0; {}", kSaveAgain));
    if (reader_.peek(start) != "$Mes" && reader_.peek(start) != "$Com")
        formats::fail(path, "is no mesh of Gmsh, which begins with $MeshFormat");
    std::optional<std::string> section = next_section();
    for (; section && *section == "Comments"; section = next_section()) skip_section(*section);
    if (section != "MeshFormat") fail("$MeshFormat is needed first");
    const std::string version(text_word());
    const double number = parse_finite(version).value_or(0);
    is_version_4_ = number == 4.1;
    if (!is_version_4_ && !(number >= 2 && number < 3)) fail(fmt::format("is MSH {}; {}", shown(version), kSaveAgain));
    is_binary_ = text_integer() == 1;
    if (const std::int64_t bytes = text_integer(); bytes != 8)
        fail(fmt::format("numbers of {} bytes: 8 are needed; {}", bytes, kSaveAgain));
    line();
    if (is_binary_) {
        const std::string one(reader_.take(4));
        is_big_endian_ = load<std::int32_t>(one.data(), true) == 1;
        if (load<std::int32_t>(one.data(), is_big_endian_) != 1)
            fail("has not the number 1 in $MeshFormat, which shows the order of bytes");
    }
    end_section(*section);
}

void MshStream::fail(const std::string& text) const {
    if (is_binary_) formats::fail(path(), fmt::format("byte {}: {}", reader_.place(), text));
    formats::fail(path(), fmt::format("line {}: {}", reader_.lines() + (is_in_line_ ? 1 : 0), text));
}

std::optional<std::string> MshStream::next_section() {
    while (const auto found = reader_.take_line()) {
        const std::string_view text = trim(*found);
        if (text.starts_with('$')) return std::string(text.substr(1));
    }
    return std::nullopt;
}

void MshStream::skip_section(const std::string& name) {
    if (!reader_.skip_past("$End" + name))
        fail(fmt::format("${} has no end; the file is truncated, fetch it again", shown(name)));
}

void MshStream::end_section(const std::string& name) {
    if (text_word() != "$End" + name) fail(fmt::format("$End{} is needed here", name));
}

std::string_view MshStream::text_word() {
    const auto word = reader_.take_word();
    is_in_line_ = word.has_value();
    if (!word) fail("ends too early: it was cut short");
    return *word;
}

std::string_view MshStream::line() {
    const auto found = reader_.take_line();
    is_in_line_ = false;
    if (!found) fail("ends too early: it was cut short");
    return *found;
}

std::int64_t MshStream::text_integer() {
    const std::string_view word = text_word();
    const auto number = parse_integer(word);
    if (!number) fail(fmt::format("'{}' stands where a whole number is needed", shown(word)));
    return *number;
}

std::int64_t MshStream::integer() { return is_binary_ ? binary<std::int32_t>() : text_integer(); }

std::uint64_t MshStream::count_line() {
    const std::int64_t count = text_integer();
    if (is_binary_) line();
    if (count < 0) fail(fmt::format("{} stands where a count is needed", count));
    return static_cast<std::uint64_t>(count);
}

std::uint64_t MshStream::size() {
    const auto number = is_binary_ && is_version_4_ ? static_cast<std::int64_t>(binary<std::uint64_t>()) : integer();
    if (number < 0) fail(fmt::format("{} stands where a count or number from 0 on is needed", number));
    return static_cast<std::uint64_t>(number);
}

double MshStream::real() {
    if (is_binary_) return binary<double>();
    const std::string_view word = text_word();
    if (const auto number = parse_real(word)) return *number;
    if (lower(word).find("inf") == std::string::npos)
        fail(fmt::format("'{}' stands where a number is needed", shown(word)));
    return std::numeric_limits<double>::infinity();
}

}  // namespace regionmesh::formats
