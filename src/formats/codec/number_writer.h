// Numbers written to binary files.
#pragma once

#include <bit>
#include <cstring>
#include <string>

#include "regionmesh/output_file.h"

namespace regionmesh::formats {

/// Writes numbers without gaps, little endian, a megabyte at a time. Call flush() at the end.
class NumberWriter {
public:
    explicit NumberWriter(OutputFile& file) : file_(file) { buffer_.reserve(kBufferBytes + 64); }
    NumberWriter(const NumberWriter&) = delete;
    NumberWriter& operator=(const NumberWriter&) = delete;

    template <class T>
    void put(T number) {
        static_assert(std::endian::native == std::endian::little);
        char bytes[sizeof(T)];
        std::memcpy(bytes, &number, sizeof(T));
        buffer_.append(bytes, sizeof(T));
        if (buffer_.size() >= kBufferBytes) flush();
    }
    void flush() {
        file_.write(buffer_);
        buffer_.clear();
    }

private:
    static constexpr std::size_t kBufferBytes = 1 << 20;

    OutputFile& file_;
    std::string buffer_;
};

}  // namespace regionmesh::formats
