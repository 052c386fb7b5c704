// Numbers for the few vertices near a star.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/ids.h"

namespace regionmesh {

/// Numbers vertices in the order in which they are first seen: a hash table that is emptied at no cost. Whether a
/// vertex is new is as good as random, so that no branch depends on it.
class VertexNumbers {
public:
    std::uint32_t size() const { return size_; }
    /// The vertex with a number.
    VertexId operator[](std::uint32_t number) const { return vertices_[number]; }
    /// The number of a vertex that has one.
    std::uint32_t of(VertexId v) const { return entries_[place_of(v, entries_.data(), shift_, search_)].number; }

    void clear() {
        size_ = 0;
        if (++search_ != 0) return;
        std::fill(entries_.begin(), entries_.end(), Entry());
        search_ = 1;
    }
    /// Sets the number of each of these vertices; new ones get the next numbers.
    void add(std::span<const VertexId> vertices, std::uint32_t* numbers) {
        make_room(size_ + vertices.size());
        // Copies: the loop need not read them again after each write.
        Entry* const entries = entries_.data();
        const std::uint32_t shift = shift_, search = search_;
        std::uint32_t size = size_;
        for (const VertexId v : vertices) {
            Entry& entry = entries[place_of(v, entries, shift, search)];
            const std::uint64_t key = key_of(v, search);
            const std::uint32_t number = entry.key != key ? size : entry.number;
            vertices_[size] = v;
            size += entry.key != key;
            entry = {key, number};
            *numbers++ = number;
        }
        size_ = size;
    }

private:
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t number = 0;
    };

    static std::uint64_t key_of(VertexId v, std::uint32_t search) { return std::uint64_t{search} << 32 | index(v); }
    /// That of the vertex, or where it belongs. Another vertex of this search differs in the lower half of the key
    /// only: one comparison tells.
    static std::size_t place_of(VertexId v, const Entry* entries, std::uint32_t shift, std::uint32_t search) {
        const std::uint64_t key = key_of(v, search);
        const std::size_t mask = (std::size_t{1} << (32 - shift)) - 1;
        std::size_t at = index(v) * 0x9E3779B1u >> shift;
        while ((entries[at].key ^ key) - 1 < ~std::uint32_t{0}) at = (at + 1) & mask;
        return at;
    }
    /// At most a fourth of the entries is in use, and less where vertices come several times.
    void make_room(std::size_t count) {
        if (vertices_.size() <= count) vertices_.resize(2 * count + 1);
        if (4 * count <= entries_.size()) return;
        entries_.assign(std::bit_ceil(8 * count), {});
        shift_ = 32 - static_cast<std::uint32_t>(std::countr_zero(entries_.size()));
        for (std::uint32_t n = 0; n < size_; ++n)
            entries_[place_of(vertices_[n], entries_.data(), shift_, search_)] = {key_of(vertices_[n], search_), n};
    }

    std::vector<Entry> entries_;      // a power of two
    std::vector<VertexId> vertices_;  // by number, and room for one more
    std::uint32_t shift_ = 31, search_ = 0, size_ = 0;
};

}  // namespace regionmesh
