// Forward streams of bytes: stored plainly, deflated, or as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/input_file.h"

namespace regionmesh::formats {

/// Holds a bounded number of bytes, independent of the length of the stream.
class ByteStream {
public:
    virtual ~ByteStream() = default;

    /// Fills `bytes` and returns the number of bytes read. Where that is too few, problem() says why and what to do.
    virtual std::size_t read(std::span<std::byte> bytes) = 0;

    /// Back to the first byte.
    virtual void rewind() = 0;

    /// To be called after the last byte needed: false, and a problem, where the rest shows that the stream is damaged.
    virtual bool finish() { return true; }
    /// Whether finish() came to the end: more than a few bytes behind those needed are not read.
    virtual bool is_read_to_end() const { return true; }

    virtual const std::string& problem() const = 0;

    /// Skips `count` bytes; false where there are fewer.
    bool skip(std::uint64_t count);
};

/// The bytes of a file, from `begin` to `end` or to the end of the file.
class PlainStream final : public ByteStream {
public:
    explicit PlainStream(InputFile file, std::uint64_t begin = 0, std::uint64_t end = UINT64_MAX)
        : file_(std::move(file)), begin_(begin), end_(end), place_(begin) {}

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    const std::string& problem() const override { return problem_; }

private:
    InputFile file_;
    std::uint64_t begin_, end_, place_;
    std::string problem_;
};

/// A stream and the number of its bytes to use.
struct StreamPart {
    std::function<std::unique_ptr<ByteStream>()> open;
    std::uint64_t bytes;
};

/// Several streams, one after another; one at a time is open.
class JoinedStream final : public ByteStream {
public:
    explicit JoinedStream(std::vector<StreamPart> parts) : parts_(std::move(parts)) {}

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    bool finish() override { return !stream_ || finish_part(); }
    bool is_read_to_end() const override { return is_read_to_end_; }
    const std::string& problem() const override { return stream_ ? stream_->problem() : problem_; }

private:
    bool finish_part();

    std::vector<StreamPart> parts_;
    std::unique_ptr<ByteStream> stream_;
    bool is_read_to_end_ = true;
    std::size_t next_ = 0;    // part
    std::uint64_t left_ = 0;  // of the stream that is open
    std::string problem_;
};

}  // namespace regionmesh::formats
