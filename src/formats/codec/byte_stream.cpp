#include "formats/codec/byte_stream.h"

#include <algorithm>
#include <array>

namespace regionmesh::formats {

bool ByteStream::skip(std::uint64_t count) {
    std::array<std::byte, 4096> waste;
    while (count > 0) {
        const std::size_t part = std::min<std::uint64_t>(count, waste.size());
        if (read(std::span(waste).first(part)) < part) return false;
        count -= part;
    }
    return true;
}

std::size_t PlainStream::read(std::span<std::byte> bytes) {
    const std::size_t wanted = std::min<std::uint64_t>(bytes.size(), end_ - place_);
    const std::size_t count = file_.read(place_, bytes.first(wanted));
    place_ += count;
    if (count < bytes.size()) problem_ = "the samples end early; the file is truncated, fetch it again";
    return count;
}

void PlainStream::rewind() {
    place_ = begin_;
    problem_.clear();
}

std::size_t JoinedStream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        if (left_ == 0) {
            if (stream_ && !finish_part()) break;
            if (next_ == parts_.size()) {
                stream_.reset();
                problem_ = "the files of samples end early; the header names too few";
                break;
            }
            stream_ = parts_[next_].open();
            left_ = parts_[next_++].bytes;
        }
        const std::size_t wanted = std::min<std::uint64_t>(bytes.size() - done, left_);
        const std::size_t count = stream_->read(bytes.subspan(done, wanted));
        done += count;
        left_ -= count;
        if (count < wanted) break;
    }
    return done;
}

bool JoinedStream::finish_part() {
    const bool is_sound = stream_->finish();
    is_read_to_end_ = is_read_to_end_ && stream_->is_read_to_end();
    return is_sound;
}

void JoinedStream::rewind() {
    stream_.reset();
    is_read_to_end_ = true;
    next_ = 0;
    left_ = 0;
}

}  // namespace regionmesh::formats
