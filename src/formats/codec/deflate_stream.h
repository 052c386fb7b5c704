// A deflated stream, with the wrapper of gzip or of zlib, inflated forward in bounded memory.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/codec/byte_stream.h"

namespace regionmesh::formats {

/// Streams of several gzip members are read as one. Check sums are verified as their members end.
class DeflateStream final : public ByteStream {
public:
    explicit DeflateStream(InputFile file, std::uint64_t begin = 0)
        : DeflateStream(std::make_unique<PlainStream>(std::move(file), begin)) {}
    explicit DeflateStream(std::unique_ptr<ByteStream> packed) : DeflateStream(std::move(packed), false) {}
    /// With `is_bare` the stream has no wrapper, as in zip archives.
    DeflateStream(std::unique_ptr<ByteStream> packed, bool is_bare);
    DeflateStream(const DeflateStream&) = delete;
    DeflateStream& operator=(const DeflateStream&) = delete;
    ~DeflateStream() override;

    std::size_t read(std::span<std::byte> bytes) override;

    /// Reads to the end to verify the last check sum, if it is at most a mebibyte away; false where the stream is
    /// damaged or truncated.
    bool finish() override;
    bool is_read_to_end() const override { return is_at_end_; }

    void rewind() override;
    const std::string& problem() const override { return problem_; }

private:
    bool refill();
    bool begin_next_member();

    std::unique_ptr<ByteStream> packed_;
    std::vector<std::byte> buffer_;  // of packed_
    z_stream stream_{};
    bool is_at_end_ = false;
    std::string problem_;
};

/// Whether the file begins as gzip does, whatever its name.
bool is_gzipped(const InputFile& file);

}  // namespace regionmesh::formats
