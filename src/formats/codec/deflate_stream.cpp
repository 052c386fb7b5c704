#include "formats/codec/deflate_stream.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

namespace regionmesh::formats {
namespace {

constexpr std::size_t kPackedBytes = std::size_t{256} << 10;
/// Inflated bytes behind those needed that are read for the sake of a check sum.
constexpr std::size_t kMostBehind = std::size_t{1} << 20;
constexpr int kAnyWrapper =
    15 + 32;  // for zlib: the largest window; the header says whether zlib or gzip wrote the stream
constexpr int kNoWrapper = -15;
constexpr std::array<std::byte, 2> kMagic{std::byte{0x1f}, std::byte{0x8b}};

}  // namespace

DeflateStream::DeflateStream(std::unique_ptr<ByteStream> packed, bool is_bare)
    : packed_(std::move(packed)), buffer_(kPackedBytes) {
    if (inflateInit2(&stream_, is_bare ? kNoWrapper : kAnyWrapper) != Z_OK) throw std::bad_alloc();
}

DeflateStream::~DeflateStream() { inflateEnd(&stream_); }

void DeflateStream::rewind() {
    inflateReset(&stream_);
    stream_.avail_in = 0;
    packed_->rewind();
    is_at_end_ = false;
    problem_.clear();
}

/// Appends packed bytes to those not yet inflated; false where there are no more.
bool DeflateStream::refill() {
    const std::size_t left = stream_.avail_in;
    if (left > 0) std::memmove(buffer_.data(), stream_.next_in, left);
    const std::size_t count = packed_->read(std::span(buffer_).subspan(left));
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_in = static_cast<uInt>(left + count);
    return count > 0;
}

/// Bytes behind the last member that are no member (padding, most often) are ignored, as gzip does.
bool DeflateStream::begin_next_member() {
    if (stream_.avail_in < kMagic.size()) refill();
    const bool is_member = stream_.avail_in >= kMagic.size() && std::memcmp(stream_.next_in, kMagic.data(), 2) == 0;
    if (is_member) inflateReset(&stream_);
    return is_member;
}

std::size_t DeflateStream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size() && problem_.empty()) {
        if (is_at_end_) {
            problem_ = "the inflated data end here, before what the header says; write the file again";
            break;
        }
        if (stream_.avail_in == 0 && !refill()) {
            problem_ = "the compressed stream ends early; the file is truncated, fetch it again";
            break;
        }
        const std::size_t wanted = std::min(bytes.size() - done, std::size_t{1} << 30);
        stream_.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
        stream_.avail_out = static_cast<uInt>(wanted);
        const int status = inflate(&stream_, Z_NO_FLUSH);
        done += wanted - stream_.avail_out;
        if (status == Z_STREAM_END) {
            is_at_end_ = !begin_next_member();
        } else if (status != Z_OK && status != Z_BUF_ERROR) {
            problem_ = std::string("the compressed stream is damaged (") + (stream_.msg ? stream_.msg : "zlib error") +
                       "); fetch the file again";
        }
    }
    return done;
}

bool DeflateStream::finish() {
    std::array<std::byte, 4096> waste;
    for (std::size_t done = 0; !is_at_end_ && done < kMostBehind; done += waste.size()) {
        const std::size_t count = read(waste);
        if (count < waste.size() && !is_at_end_) return false;
    }
    problem_.clear();
    return true;
}

bool is_gzipped(const InputFile& file) {
    std::array<std::byte, kMagic.size()> start{};
    return file.read(0, start) == start.size() && start == kMagic;
}

}  // namespace regionmesh::formats
