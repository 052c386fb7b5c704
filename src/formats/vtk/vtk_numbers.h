// The numbers of an array in a VTK XML file, pulled in order.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "formats/vtk/vtk_xml.h"
#include "regionmesh/vec3.h"

namespace regionmesh::formats {

/// Holds 64 KiB of the array at a time. Throws Error(kInput) that names file and array.
class VtkNumbers {
public:
    /// Throws where the array says that it has other than `count` numbers; ascii arrays do not say it. Refers to `xml`.
    VtkNumbers(const VtkXml& xml, pugi::xml_node array, std::optional<std::uint64_t> count);

    /// The next number. An integer keeps its bits; where integers are needed, a real must be whole and below 2^53.
    std::int64_t integer();
    double real();
    /// Three reals.
    Vec3 point();
    void skip(std::uint64_t count);

    /// Whether all numbers were taken.
    bool at_end();
    /// To be called after the last number: throws where there are more, or where a check sum does not agree.
    void finish();

private:
    bool refill();
    void require_number();
    [[noreturn]] void fail(const std::string& text) const { xml_.fail(array_, text); }

    const VtkXml& xml_;
    pugi::xml_node array_;
    NumberType type_;
    bool is_real_;
    std::optional<std::uint64_t> count_;  // as the array says; none for ascii
    std::unique_ptr<ByteStream> stream_;  // or, for ascii,
    std::optional<ByteReader> words_;
    std::uint64_t taken_ = 0;
    std::vector<std::byte> bytes_;
    std::vector<std::int64_t> integers_;  // those at hand, or
    std::vector<double> reals_;
    std::size_t next_ = 0, held_ = 0;
};

/// The same for an array of integers: throws for one of reals.
VtkNumbers integers_of(const VtkXml& xml, pugi::xml_node array, std::optional<std::uint64_t> count);

/// The reals of an array in the field data: one tuple of `count` of them. Empty where there is none, or one of another
/// type or shape, which is another program's. Throws where its numbers cannot be read.
std::vector<double> tuple_of(const VtkXml& xml, const char* name, std::uint64_t count);

/// The metres in a unit of length that the field data say; none where they say no such number.
std::optional<double> metres_per_unit(const VtkXml& xml);

/// The array of points of a piece. Throws where it has not three components.
VtkNumbers points_of(const VtkXml& xml, pugi::xml_node piece, std::uint64_t count);

}  // namespace regionmesh::formats
