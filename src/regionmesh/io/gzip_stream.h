// A gzip file inflated forward in bounded memory.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "regionmesh/io/input_file.h"

namespace regionmesh::io {

/// Files of several gzip members are read as one. Check sums are verified as their members end.
class GzipStream {
public:
    explicit GzipStream(InputFile file);
    GzipStream(const GzipStream&) = delete;
    GzipStream& operator=(const GzipStream&) = delete;
    ~GzipStream();

    const InputFile& file() const { return file_; }

    /// Fills `bytes`; returns how many there were. Where they are fewer, problem() says why and what to do.
    std::size_t read(std::span<std::byte> bytes);

    /// Passes over `count` bytes; false where there are fewer.
    bool skip(std::uint64_t count);

    /// Reads to the end, so that the last check sum is verified too; false where the stream is damaged or cut off.
    bool finish();

    /// Back to the first byte.
    void rewind();

    const std::string& problem() const { return problem_; }

private:
    bool refill();
    bool begin_next_member();

    InputFile file_;
    std::vector<std::byte> packed_;
    std::uint64_t packed_offset_ = 0;
    z_stream stream_{};
    bool is_at_end_ = false;
    std::string problem_;
};

}  // namespace regionmesh::io
