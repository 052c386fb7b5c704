// The candidate edges, cheapest first.
#pragma once

#include <cstdint>

#include "regionmesh/flat_array.h"
#include "regionmesh/ids.h"

namespace regionmesh {

/// An indexed four-fold heap. Every candidate edge is owned by the vertex that would go, and a vertex stands in the
/// heap with the cheapest edge it owns: a third of the entries that one per edge would need. Ties go to the lower
/// vertex id, so that the order depends on what is in the heap only, not on how it came there.
class EdgeHeap {
public:
    explicit EdgeHeap(std::uint32_t vertex_end) { place_.resize(vertex_end, kAbsent); }

    bool empty() const { return entries_.empty(); }
    std::uint32_t size() const { return entries_.size(); }
    bool contains(VertexId v) const { return place_[index(v)] != kAbsent; }
    VertexId top() const { return entries_[0].vertex; }
    float top_key() const { return entries_[0].key; }
    float key(VertexId v) const { return entries_[place_[index(v)]].key; }

    /// Inserts v, or changes its key.
    void set(VertexId v, float key) {
        std::uint32_t place = place_[index(v)];
        if (place == kAbsent) {
            place = entries_.size();
            entries_.push_back({key, v});
            rise(place, {key, v});
        } else if (is_before({key, v}, entries_[place])) {
            rise(place, {key, v});
        } else {
            sink(place, {key, v});
        }
    }
    /// Takes v out if it is in.
    void remove(VertexId v) {
        const std::uint32_t place = place_[index(v)];
        if (place == kAbsent) return;
        place_[index(v)] = kAbsent;
        const Entry last = entries_[entries_.size() - 1];
        entries_.resize(entries_.size() - 1);
        if (place == entries_.size()) return;
        if (place > 0 && is_before(last, entries_[(place - 1) / kFan]))
            rise(place, last);
        else
            sink(place, last);
    }
    std::size_t bytes() const { return entries_.bytes() + place_.bytes(); }

private:
    static constexpr std::uint32_t kAbsent = 0xFFFFFFFFu;
    static constexpr std::uint32_t kFan = 4;
    struct Entry {
        float key;
        VertexId vertex;
    };

    static bool is_before(Entry a, Entry b) { return a.key < b.key || (a.key == b.key && a.vertex < b.vertex); }
    void put(std::uint32_t place, Entry entry) {
        entries_[place] = entry;
        place_[index(entry.vertex)] = place;
    }
    void rise(std::uint32_t place, Entry entry) {
        while (place > 0) {
            const std::uint32_t parent = (place - 1) / kFan;
            if (!is_before(entry, entries_[parent])) break;
            put(place, entries_[parent]);
            place = parent;
        }
        put(place, entry);
    }
    void sink(std::uint32_t place, Entry entry) {
        for (;;) {
            const std::uint32_t first = place * kFan + 1;
            if (first >= entries_.size()) break;
            std::uint32_t best = first;
            for (std::uint32_t child = first + 1; child < first + kFan && child < entries_.size(); ++child)
                if (is_before(entries_[child], entries_[best])) best = child;
            if (!is_before(entries_[best], entry)) break;
            put(place, entries_[best]);
            place = best;
        }
        put(place, entry);
    }

    FlatArray<Entry> entries_;
    FlatArray<std::uint32_t> place_;
};

}  // namespace regionmesh
