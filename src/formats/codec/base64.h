// Base64 (RFC 4648, section 4), piece by piece, so that neither side ever holds a whole array as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace regionmesh {

/// Encodes one stream of bytes given in pieces of any size.
class Base64Encoder {
public:
    /// Appends the text of all whole groups of three bytes to `text`; up to two bytes wait for the next piece.
    void encode(std::span<const std::byte> bytes, std::string& text);
    /// Ends the stream: the waiting bytes, padded. The encoder is then ready for a new stream.
    void finish(std::string& text);

private:
    std::byte waiting_[3];
    int waiting_count_ = 0;
};

/// The text of `bytes` as a stream of its own.
std::string base64(std::span<const std::byte> bytes);

/// The length of the text of a whole stream.
constexpr std::uint64_t base64_length(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

/// Decodes text as it is asked for. White space is skipped. Streams that follow one another, each with its own padding,
/// read as one: so a VTK header and its data do, whether they were encoded together or apart.
class Base64Decoder {
public:
    /// Holds a reference to the text.
    explicit Base64Decoder(std::string_view text) : text_(text) {}

    /// Fills `bytes` and returns how many it could: fewer where the text ends, or is no base64 from there on.
    std::size_t read(std::span<std::byte> bytes);
    /// Whether the text was found to be no base64.
    bool has_failed() const { return has_failed_; }
    /// No more bytes than these can follow.
    std::size_t most_left() const {
        return static_cast<std::size_t>(waiting_count_ - waiting_begin_) + (text_.size() - place_) / 4 * 3;
    }

private:
    bool read_group();

    std::string_view text_;
    std::size_t place_ = 0;
    std::byte waiting_[3];
    int waiting_begin_ = 0;
    int waiting_count_ = 0;
    bool has_failed_ = false;
};

}  // namespace regionmesh
