// How one sample is stored, and how stored samples become labels.
#pragma once

#include <cstddef>
#include <span>

#include "formats/codec/numbers.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

struct SampleFormat {
    SampleType type = SampleType::kU8;
    bool is_big_endian = false;
};

/// How a sample is stored: both enumerations list the integers in the same order.
NumberType number_type(SampleType type);
SampleType sample_type(NumberType integer);

/// Bytes of a stored sample. kU1 takes one byte here; image_shape.h decodes images with packed bits.
std::size_t sample_bytes(SampleType type);

/// The numbers that a type holds; kU1 those of its byte.
struct SampleRange {
    std::int64_t least = 0;
    std::uint64_t most = 0;

    /// Is the label in the range? Its bits are those of an unsigned number, unless it is a negative one.
    bool holds(InputLabel label, bool is_negative) const {
        return is_negative ? label >= least : static_cast<std::uint64_t>(label) <= most;
    }
};
SampleRange range_of(SampleType type);

/// Turns samples that begin `pitch` bytes apart into labels. Signed samples keep their sign, 64-bit unsigned ones their
/// bits, and any kU1 sample other than 0 is 1. `bytes` need not be aligned.
void decode_samples(const std::byte* bytes, std::size_t pitch, SampleFormat format, std::span<InputLabel> labels);

}  // namespace regionmesh::formats
