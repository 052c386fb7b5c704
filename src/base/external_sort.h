// Sorts more items than fit into memory.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/temporary_file.h"

namespace regionmesh {

/// External merge sort; re-iterable; not stable. Holds at most the given number of bytes: full buffers are sorted and
/// written as runs to a temporary file, which are merged while reading.
template <class Item>
class ExternalSort {
public:
    explicit ExternalSort(std::uint64_t bytes) : room_(std::max<std::uint64_t>(bytes / sizeof(Item), 1024)) {}

    std::uint64_t size() const { return size_; }
    std::uint64_t bytes() const {
        std::uint64_t sum = buffer_.capacity() * sizeof(Item);
        for (const Run& run : runs_) sum += run.piece.capacity() * sizeof(Item);
        return sum;
    }

    void add(const Item& item) {
        if (buffer_.size() == room_) put_aside();
        if (buffer_.size() == buffer_.capacity())
            buffer_.reserve(std::min<std::uint64_t>(std::max<std::uint64_t>(2 * buffer_.size(), 1024), room_));
        buffer_.push_back(item);
        ++size_;
    }

    /// Ends the input. next() then begins with the smallest item, and again after each rewind().
    void finish() {
        if (!file_) {
            std::sort(buffer_.begin(), buffer_.end());
        } else {
            put_aside();
            buffer_ = {};
        }
        rewind();
    }

    void rewind() {
        place_ = 0;
        heap_.clear();
        const std::uint64_t items = std::max<std::uint64_t>(room_ / std::max<std::size_t>(runs_.size(), 1), 64);
        for (Run& run : runs_) {
            run.next_item = run.begin;
            run.piece.clear();
            run.at = 0;
            run.piece_items = std::min<std::uint64_t>(items, kPieceItems);
            if (refill(run)) heap_.push_back(&run);
        }
        std::make_heap(heap_.begin(), heap_.end(), is_behind);
    }

    /// Reads the next item; returns false at the end.
    bool next(Item& item) {
        if (!file_) {
            if (place_ == buffer_.size()) return false;
            item = buffer_[place_++];
            return true;
        }
        if (heap_.empty()) return false;
        std::pop_heap(heap_.begin(), heap_.end(), is_behind);
        Run& run = *heap_.back();
        item = run.piece[run.at++];
        if (run.at == run.piece.size() && !refill(run))
            heap_.pop_back();
        else
            std::push_heap(heap_.begin(), heap_.end(), is_behind);
        return true;
    }

private:
    static constexpr std::uint64_t kPieceItems = 1 << 14;

    struct Run {
        std::uint64_t begin, end;     // range of items in the file
        std::uint64_t next_item = 0;  // index of the next item to read
        std::vector<Item> piece = {};
        std::size_t at = 0;
        std::uint64_t piece_items = 0;
    };
    static bool is_behind(const Run* a, const Run* b) { return b->piece[b->at] < a->piece[a->at]; }

    void put_aside() {
        std::sort(buffer_.begin(), buffer_.end());
        if (!file_) file_.emplace();
        const std::uint64_t begin = file_->size();
        file_->append_items(std::span<const Item>(buffer_));
        runs_.push_back({begin, file_->size()});
        buffer_.clear();
    }

    bool refill(Run& run) {
        const std::uint64_t count = std::min(run.piece_items, (run.end - run.next_item) / sizeof(Item));
        run.at = 0;
        run.next_item = file_->read_items(run.next_item, count, run.piece);
        return count > 0;
    }

    std::uint64_t room_, size_ = 0;
    std::vector<Item> buffer_;
    std::size_t place_ = 0;
    std::optional<TemporaryFile> file_;
    std::vector<Run> runs_;
    std::vector<Run*> heap_;
};

}  // namespace regionmesh
