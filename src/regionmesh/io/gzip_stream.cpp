#include "regionmesh/io/gzip_stream.h"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

namespace regionmesh::io {
namespace {

constexpr std::size_t kPackedBytes = std::size_t{256} << 10;
constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, gzip header and trailer
constexpr std::array<std::byte, 2> kMagic{std::byte{0x1f}, std::byte{0x8b}};

}  // namespace

GzipStream::GzipStream(InputFile file) : file_(std::move(file)), packed_(kPackedBytes) {
    if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw std::bad_alloc();
}

GzipStream::~GzipStream() { inflateEnd(&stream_); }

void GzipStream::rewind() {
    inflateReset(&stream_);
    stream_.avail_in = 0;
    packed_offset_ = 0;
    is_at_end_ = false;
    problem_.clear();
}

bool GzipStream::refill() {
    const std::size_t count = file_.read(packed_offset_, packed_);
    packed_offset_ += count;
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(count);
    return count > 0;
}

/// What follows the last member and is not one itself (padding, most often) is passed over, as gzip does.
bool GzipStream::begin_next_member() {
    std::array<std::byte, 2> start{};
    const bool is_member = file_.read(packed_offset_ - stream_.avail_in, start) == start.size() && start == kMagic;
    if (is_member) inflateReset(&stream_);
    return is_member;
}

std::size_t GzipStream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size() && problem_.empty()) {
        if (is_at_end_) {
            problem_ = "the inflated data end here, before what the header says; write the file again";
            break;
        }
        if (stream_.avail_in == 0 && !refill()) {
            problem_ = "the gzip stream ends early; the file is truncated, fetch it again";
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
            problem_ = std::string("the gzip stream is damaged (") + (stream_.msg ? stream_.msg : "zlib error") +
                       "); fetch the file again";
        }
    }
    return done;
}

bool GzipStream::skip(std::uint64_t count) {
    std::array<std::byte, 4096> waste;
    while (count > 0) {
        const std::size_t part = std::min<std::uint64_t>(count, waste.size());
        if (read(std::span(waste).first(part)) < part) return false;
        count -= part;
    }
    return true;
}

bool GzipStream::finish() {
    std::array<std::byte, 4096> waste;
    while (!is_at_end_) {
        const std::size_t count = read(waste);
        if (count < waste.size() && !is_at_end_) return false;
    }
    problem_.clear();
    return true;
}

}  // namespace regionmesh::io
