// The numbers by which a Gmsh mesh calls its nodes or elements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace regionmesh::formats {

/// Tags in the order in which they come; holds none of them while each is one more than the one before.
class MshTags {
public:
    void add(std::uint64_t tag);
    /// To be called before find. Returns a tag that was added twice, if there is one.
    std::optional<std::uint64_t> finish();

    std::uint64_t size() const { return count_; }
    std::uint64_t operator[](std::uint32_t index) const { return tags_.empty() ? first_ + index : tags_[index]; }
    /// The place of a tag among all.
    std::optional<std::uint32_t> find(std::uint64_t tag) const;

private:
    std::uint64_t first_ = 0, count_ = 0;
    std::vector<std::uint64_t> tags_;   // none while they are first_, first_ + 1, ...
    std::vector<std::uint32_t> order_;  // by rising tag; none where that is the order of tags_
};

}  // namespace regionmesh::formats
