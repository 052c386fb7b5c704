// How one sample is stored, and how stored samples become labels.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "formats/codec/numbers.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

struct SampleFormat {
    SampleType type = SampleType::kU8;  // of the labels
    bool is_big_endian = false;
    std::optional<NumberType> real = {};  // as which samples are stored, if not as integers of the type
    double slope = 1, intercept = 0;      // a label is slope * stored + intercept
    bool is_ordered = false;              // labels are ordered_label() of the samples, which may be any numbers

    /// Whether samples are more than integers of the type: then some may be no labels.
    bool is_real() const { return real || slope != 1 || intercept != 0; }
};

/// The type of the labels: kI64 of reals and scaled samples.
SampleType label_type(const SampleFormat& format);

/// Samples of 4 or 8 bytes that are reals.
SampleFormat real_format(NumberType real, bool is_big_endian);

/// A label that stands for a real: it is larger for larger ones, and least for NaN. 0 and -0 have one.
InputLabel ordered_label(double value);

/// A sample that is no label.
struct NoLabel {
    std::size_t index = 0;
    double value = 0;
};
/// "is 0.5; labels are whole numbers: ..."
std::string why_no_label(double value);

/// How a sample is stored: both enumerations list the integers in the same order.
NumberType number_type(SampleType type);
SampleType sample_type(NumberType integer);

/// Bytes of a stored sample. kU1 takes one byte here; image_shape.h decodes images with packed bits.
std::size_t sample_bytes(SampleType type);
std::size_t sample_bytes(const SampleFormat& format);

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
/// bits, and any kU1 sample other than 0 is 1. `bytes` need not be aligned. Reals and scaled samples must be whole
/// numbers below 2^53, up to the rounding of the scale: returns the first that is not, and stops.
std::optional<NoLabel> decode_samples(const std::byte* bytes, std::size_t pitch, const SampleFormat& format,
                                      std::span<InputLabel> labels);

}  // namespace regionmesh::formats
