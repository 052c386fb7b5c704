// The numbers of an array in a VTK XML file, pulled in order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/codec/sample_format.h"
#include "formats/vtk/vtk_xml_tags.h"

namespace regionmesh::formats {

/// Whether arrays of that type of VTK's can be read, and hold integers.
bool is_vtk_integer(std::string_view type);
bool is_vtk_real(std::string_view type);

/// Holds 64 KiB of the array at a time. Throws Error(kInput) that names file and array.
class VtkNumbers {
public:
    /// An array that says it has other than `count` numbers is an error; ascii does not say it.
    VtkNumbers(const std::filesystem::path& path, const VtkXmlTags& tags, pugi::xml_node array,
               std::optional<std::uint64_t> count);

    /// The next number. An integer keeps its bits; where integers are needed, a real must be whole and below 2^53.
    std::int64_t integer();
    double real();
    void skip(std::uint64_t count);

private:
    void begin_plain(const VtkArrayPlace& place, std::size_t word_bytes);
    void begin_compressed(const VtkArrayPlace& place, const VtkEncoding& encoding);
    void check_bytes(std::uint64_t bytes);
    void refill();
    [[noreturn]] void fail(const std::string& text) const;

    std::filesystem::path path_;
    std::string name_;
    bool is_real_;
    SampleFormat format_;     // of integers
    std::size_t bytes_each_;  // in the stream
    std::unique_ptr<ByteStream> stream_;
    std::optional<std::uint64_t> count_;  // ascii without a count: none
    std::uint64_t taken_ = 0;
    std::vector<std::byte> bytes_;
    std::vector<InputLabel> integers_;  // those at hand, or
    std::vector<double> reals_;
    std::size_t next_ = 0, held_ = 0;
};

}  // namespace regionmesh::formats
