#include "formats/vtk/vtk_blocks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <utility>

namespace regionmesh::formats {
namespace {

constexpr std::size_t kPackedBytes = std::size_t{64} << 10;
constexpr const char* kCutTable = "the table of its blocks is cut short; fetch the file again";
constexpr std::uint64_t kMostBytes = std::numeric_limits<std::int64_t>::max();

}  // namespace

VtkBlocks::VtkBlocks(std::unique_ptr<ByteStream> table, std::unique_ptr<ByteStream> blocks, const VtkEncoding& encoding)
    : table_(std::move(table)), blocks_(std::move(blocks)), encoding_(encoding), packed_(kPackedBytes) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
}

VtkBlocks::~VtkBlocks() { inflateEnd(&stream_); }

bool VtkBlocks::read_words(std::span<std::uint64_t> words) {
    for (std::uint64_t& word : words) {
        std::array<std::byte, 8> bytes{};
        if (table_->read(std::span(bytes).first(encoding_.word_bytes)) < encoding_.word_bytes) {
            problem_ = kCutTable;
            return false;
        }
        word = decode_word(std::span(bytes).first(encoding_.word_bytes), encoding_.is_big_endian);
    }
    return true;
}

bool VtkBlocks::begin() {
    std::array<std::uint64_t, 3> head{};
    if (has_begun_ || !read_words(head)) return has_begun_;
    count_ = head[0], full_bytes_ = head[1];
    last_bytes_ = head[2] == 0 ? full_bytes_ : head[2];
    if (count_ > kMostBytes / encoding_.word_bytes - 3 || !blocks_->skip((3 + count_) * encoding_.word_bytes)) {
        problem_ = kCutTable;
        return false;
    }
    has_begun_ = true;
    return true;
}

std::optional<std::uint64_t> VtkBlocks::inflated_bytes() {
    if (!begin()) return std::nullopt;
    if (count_ == 0) return 0;
    const std::uint64_t most = std::max<std::uint64_t>({full_bytes_, last_bytes_, 1});
    if (count_ > kMostBytes / most) {
        problem_ = "has more blocks than any file holds; write the file again";
        return std::nullopt;
    }
    return (count_ - 1) * full_bytes_ + last_bytes_;
}

/// To the check sum; what is left behind it is passed over.
bool VtkBlocks::end_block() {
    Bytef nothing = 0;
    while (is_open_) {
        if (stream_.avail_in == 0 && !refill()) return false;
        stream_.next_out = &nothing;
        stream_.avail_out = 0;
        const int status = inflate(&stream_, Z_NO_FLUSH);
        is_open_ = status != Z_STREAM_END;
        if (!is_open_ || (status == Z_OK && stream_.avail_in == 0)) continue;
        problem_ = "a compressed block is damaged; fetch the file again";
        return false;
    }
    if (blocks_->skip(std::exchange(packed_left_, 0))) return true;
    problem_ = blocks_->problem();
    return false;
}

bool VtkBlocks::begin_block() {
    std::uint64_t size = 0;
    if (next_ == count_) {
        problem_ = "the compressed blocks end before what the header says; write the file again";
        return false;
    }
    if (!end_block() || !read_words(std::span(&size, 1))) return false;
    packed_left_ = size;
    left_ = ++next_ == count_ ? last_bytes_ : full_bytes_;
    is_open_ = true;
    inflateReset(&stream_);
    stream_.avail_in = 0;
    return true;
}

bool VtkBlocks::refill() {
    const std::size_t wanted = std::min<std::uint64_t>(packed_.size(), packed_left_);
    if (wanted == 0 || blocks_->read(std::span(packed_).first(wanted)) < wanted) {
        problem_ = wanted == 0 ? "a compressed block ends early; write the file again" : blocks_->problem();
        return false;
    }
    packed_left_ -= wanted;
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(wanted);
    return true;
}

std::size_t VtkBlocks::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    if (!begin()) return done;
    while (done < bytes.size() && problem_.empty()) {
        if (left_ == 0) {
            if (!begin_block()) break;
            continue;
        }
        if (stream_.avail_in == 0 && !refill()) break;
        const std::size_t wanted = std::min<std::uint64_t>({bytes.size() - done, left_, std::uint64_t{1} << 30});
        stream_.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
        stream_.avail_out = static_cast<uInt>(wanted);
        const int status = inflate(&stream_, Z_NO_FLUSH);
        done += wanted - stream_.avail_out;
        left_ -= wanted - stream_.avail_out;
        if (status == Z_STREAM_END) is_open_ = false;
        if ((status != Z_OK && status != Z_BUF_ERROR && status != Z_STREAM_END) || (!is_open_ && left_ > 0))
            problem_ = "a compressed block is damaged; fetch the file again";
    }
    return done;
}

void VtkBlocks::rewind() {
    table_->rewind();
    blocks_->rewind();
    has_begun_ = is_open_ = false;
    next_ = left_ = packed_left_ = 0;
    problem_.clear();
}

}  // namespace regionmesh::formats
