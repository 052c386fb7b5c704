#include "formats/vtk/vtk_blocks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace regionmesh::formats {
namespace {

constexpr const char* kCutTable = "the table of its blocks is cut short; fetch the file again";
constexpr std::uint64_t kMostBytes = std::numeric_limits<std::int64_t>::max();

}  // namespace

class VtkBlocks::Block final : public ByteStream {
public:
    explicit Block(VtkBlocks& all) : all_(all) {}

    std::size_t read(std::span<std::byte> bytes) override {
        const std::size_t wanted = std::min<std::uint64_t>(bytes.size(), all_.packed_left_);
        const std::size_t count = all_.blocks_->read(bytes.first(wanted));
        all_.packed_left_ -= count;
        return count;
    }
    void rewind() override {}
    const std::string& problem() const override { return all_.blocks_->problem(); }

private:
    VtkBlocks& all_;
};

VtkBlocks::VtkBlocks(std::unique_ptr<ByteStream> table, std::unique_ptr<ByteStream> blocks, const VtkEncoding& encoding)
    : table_(std::move(table)),
      blocks_(std::move(blocks)),
      encoding_(encoding),
      inflated_(std::make_unique<Block>(*this)) {}

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

/// Verifies the check sum; a block that inflates to more than the table says is damaged. Ignores the bytes behind it.
bool VtkBlocks::end_block() {
    std::byte more;
    if (is_open_ && (inflated_.read(std::span(&more, 1)) > 0 || !inflated_.finish())) {
        problem_ = "a compressed block is damaged; fetch the file again";
        return false;
    }
    is_open_ = false;
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
    inflated_.rewind();
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
        const std::size_t wanted = std::min<std::uint64_t>(bytes.size() - done, left_);
        const std::size_t count = inflated_.read(bytes.subspan(done, wanted));
        done += count;
        left_ -= count;
        if (count < wanted)
            problem_ =
                blocks_->problem().empty() ? "a compressed block is damaged; fetch the file again" : blocks_->problem();
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
