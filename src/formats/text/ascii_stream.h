// Samples written as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "formats/codec/byte_reader.h"
#include "formats/codec/byte_stream.h"
#include "formats/codec/sample_format.h"

namespace regionmesh::formats {

inline constexpr std::size_t kAsciiBytes = 8;  // of a number

/// The format of the bytes of an AsciiStream, whatever the header says: integers of 64 bits, or reals.
inline SampleFormat ascii_format(SampleFormat format) {
    format.type = SampleType::kI64;
    format.is_big_endian = false;
    if (format.real) format.real = NumberType::kFloat64;
    return format;
}

/// A number takes at least two letters, a digit and a blank, except the last.
constexpr std::uint64_t most_ascii_samples(std::uint64_t letters) { return letters / 2 + 1; }

/// The numbers in a text between blanks or commas, each as the eight bytes of a little-endian integer or real; integers
/// above 2^63 - 1 as the bits of an unsigned one. Numbers that the type does not hold are a problem.
class AsciiStream final : public ByteStream {
public:
    /// The text from `begin` to `end` is to hold `count` numbers.
    AsciiStream(InputFile file, const SampleFormat& format, std::uint64_t count, std::uint64_t begin = 0,
                std::uint64_t end = UINT64_MAX)
        : type_(format.type),
          is_real_(format.real),
          count_(count),
          begin_(begin),
          words_(std::move(file), begin, end, kBlanksAndCommas) {}

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    /// False where anything is left behind the last number: with another size, each row begins at another place.
    bool finish() override;
    const std::string& problem() const override { return problem_; }

private:
    bool take_number();
    bool take_real(std::string_view word);
    template <class Number>
    void put(Number number);

    SampleType type_;
    bool is_real_;
    std::uint64_t count_, taken_ = 0;
    std::uint64_t begin_;
    ByteReader words_;
    std::byte number_[kAsciiBytes];
    std::size_t number_place_ = sizeof number_;
    std::string problem_;
};

}  // namespace regionmesh::formats
