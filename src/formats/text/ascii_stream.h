// Samples written as text.
#pragma once

#include <cstdint>
#include <string>

#include "formats/codec/byte_reader.h"
#include "formats/codec/byte_stream.h"
#include "formats/codec/sample_format.h"

namespace regionmesh::formats {

/// The format of the bytes of an AsciiStream, whatever type the header says: integers of 64 bits.
inline constexpr SampleFormat kAsciiFormat{.type = SampleType::kI64};

/// A number takes at least two letters, a digit and a blank, except the last.
constexpr std::uint64_t most_ascii_samples(std::uint64_t letters) { return letters / 2 + 1; }

/// The whole numbers in a text between blanks or commas, each as the eight bytes of a little-endian integer; above
/// 2^63 - 1 the bits of an unsigned one. Numbers that the type does not hold are a problem.
class AsciiStream final : public ByteStream {
public:
    /// The text from `begin` to `end` is to hold `count` numbers.
    AsciiStream(InputFile file, SampleType type, std::uint64_t count, std::uint64_t begin = 0,
                std::uint64_t end = UINT64_MAX)
        : type_(type), count_(count), begin_(begin), words_(std::move(file), begin, end, kBlanksAndCommas) {}

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    /// False where anything is left behind the last number: with another size, each row begins at another place.
    bool finish() override;
    const std::string& problem() const override { return problem_; }

private:
    bool take_number();

    SampleType type_;
    std::uint64_t count_, taken_ = 0;
    std::uint64_t begin_;
    ByteReader words_;
    std::byte number_[8];
    std::size_t number_place_ = sizeof number_;
    std::string problem_;
};

}  // namespace regionmesh::formats
