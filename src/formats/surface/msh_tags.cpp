#include "formats/surface/msh_tags.h"

#include <algorithm>
#include <numeric>

namespace regionmesh::formats {

void MshTags::add(std::uint64_t tag) {
    if (count_ == 0) first_ = tag;
    if (tags_.empty() && tag != first_ + count_) {
        tags_.resize(count_);
        std::iota(tags_.begin(), tags_.end(), first_);
    }
    if (!tags_.empty()) tags_.push_back(tag);
    ++count_;
}

std::optional<std::uint64_t> MshTags::finish() {
    if (!std::is_sorted(tags_.begin(), tags_.end())) {
        order_.resize(tags_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return tags_[a] < tags_[b]; });
    }
    const auto tag_at = [&](std::size_t i) { return tags_[order_.empty() ? i : order_[i]]; };
    for (std::size_t i = 1; i < tags_.size(); ++i)
        if (tag_at(i) == tag_at(i - 1)) return tag_at(i);
    return std::nullopt;
}

std::optional<std::uint32_t> MshTags::find(std::uint64_t tag) const {
    if (tags_.empty()) {
        if (tag < first_ || tag - first_ >= count_) return std::nullopt;
        return static_cast<std::uint32_t>(tag - first_);
    }
    if (order_.empty()) {
        const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
        if (found == tags_.end() || *found != tag) return std::nullopt;
        return static_cast<std::uint32_t>(found - tags_.begin());
    }
    const auto found = std::lower_bound(order_.begin(), order_.end(), tag,
                                        [&](std::uint32_t i, std::uint64_t wanted) { return tags_[i] < wanted; });
    if (found == order_.end() || tags_[*found] != tag) return std::nullopt;
    return *found;
}

}  // namespace regionmesh::formats
