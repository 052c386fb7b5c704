// Base64 text in a file, decoded forward in bounded memory.
#pragma once

#include <cstdint>
#include <string>

#include "formats/codec/base64.h"
#include "formats/codec/byte_stream.h"

namespace regionmesh::formats {

/// White space is skipped; the text ends at the first '<' or at `end`. Padding may stand between two streams that
/// follow one another.
class Base64Stream final : public ByteStream {
public:
    explicit Base64Stream(InputFile file, std::uint64_t begin = 0, std::uint64_t end = UINT64_MAX)
        : file_(std::move(file)), begin_(begin), end_(end), place_(begin) {}

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    const std::string& problem() const override { return problem_; }

private:
    bool refill();

    InputFile file_;
    std::uint64_t begin_, end_, place_;
    std::string text_;  // letters only, whole groups of four; what is left of a group waits in letters_
    std::string letters_;
    Base64Decoder decoder_{std::string_view()};
    std::string problem_;
};

}  // namespace regionmesh::formats
