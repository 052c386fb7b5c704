// Samples written as text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/codec/byte_stream.h"
#include "formats/codec/sample_format.h"

namespace regionmesh::formats {

/// How the bytes of an AsciiStream are to be decoded, whatever type the header says: numbers of 64 bits.
inline constexpr SampleFormat kAsciiFormat{.type = SampleType::kI64};

/// A number takes two letters at least, with the blank behind it, but for the last.
constexpr std::uint64_t most_ascii_samples(std::uint64_t letters) { return letters / 2 + 1; }

enum class AsciiNumbers { kIntegers, kReals };

/// The numbers in a text between blanks (or commas), each as the eight bytes of a little-endian integer, and beyond the
/// signed ones the bits of an unsigned one; or each as those of a real, which may be NaN.
class AsciiStream final : public ByteStream {
public:
    explicit AsciiStream(InputFile file, std::uint64_t begin = 0, std::uint64_t end = UINT64_MAX,
                         AsciiNumbers numbers = AsciiNumbers::kIntegers);

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    const std::string& problem() const override { return problem_; }

private:
    bool next_word();
    bool refill();
    bool parse_word();

    InputFile file_;
    AsciiNumbers numbers_;
    std::uint64_t begin_, end_, place_;
    std::vector<char> text_;
    std::size_t text_place_ = 0;
    std::string word_;
    std::byte number_[8];
    std::size_t number_place_ = sizeof number_;
    std::string problem_;
};

}  // namespace regionmesh::formats
