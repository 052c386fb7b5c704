// Base64 (RFC 4648, section 4), encoded and decoded in pieces: neither side ever holds a whole array as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "formats/codec/byte_stream.h"

namespace regionmesh {

/// Encodes one stream of bytes, given in pieces of any size.
class Base64Encoder {
public:
    /// Appends the text of all whole groups of three bytes to `text`; up to two bytes wait for the next piece.
    void encode(std::span<const std::byte> bytes, std::string& text);
    /// Ends the stream: encodes the waiting bytes with padding. The encoder is then ready for a new stream.
    void finish(std::string& text);

private:
    std::byte waiting_[3];
    int waiting_count_ = 0;
};

/// The text of `bytes` as a stream of its own.
std::string base64(std::span<const std::byte> bytes);

/// The length of the text of a whole stream.
constexpr std::uint64_t base64_length(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

namespace formats {

/// Decodes base64 text in a file, in bounded memory. Skips white space; the text ends at the first '<' or at `end`.
/// Streams that follow one another, each with its own padding, read as one: a VTK header and its data may have been
/// encoded together or apart.
class Base64Stream final : public ByteStream {
public:
    explicit Base64Stream(InputFile file, std::uint64_t begin = 0, std::uint64_t end = UINT64_MAX)
        : file_(std::move(file)), begin_(begin), end_(end), place_(begin) {}

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    const std::string& problem() const override { return problem_; }

private:
    bool read_group();
    char next_letter();

    InputFile file_;
    std::uint64_t begin_, end_, place_;  // in the file
    std::string text_;
    std::size_t next_ = 0;  // in text_
    std::byte waiting_[3];
    int waiting_begin_ = 0, waiting_count_ = 0;
    std::string problem_;
};

}  // namespace formats
}  // namespace regionmesh
