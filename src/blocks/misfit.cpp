#include "blocks/misfit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/hash.h"

namespace regionmesh {
namespace {

/// Lists of entries by the lowest vertex that they have.
template <class Entry>
class ByVertex {
public:
    explicit ByVertex(std::size_t vertices) : ends_(vertices + 1) {}

    void count(std::uint32_t vertex) { ++ends_[vertex + 1]; }
    void end_count() {
        for (std::size_t v = 1; v < ends_.size(); ++v) ends_[v] += ends_[v - 1];
        entries_.resize(ends_.back());
        next_ = ends_;
    }
    void add(std::uint32_t vertex, const Entry& entry) { entries_[next_[vertex]++] = entry; }
    std::span<Entry> of(std::uint32_t vertex) {
        return std::span(entries_).subspan(ends_[vertex], ends_[vertex + 1] - ends_[vertex]);
    }

private:
    std::vector<std::size_t> ends_, next_;
    std::vector<Entry> entries_;
};

std::string text_of(Vec3 p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

/// The corners of a face, lowest first.
std::array<std::uint32_t, 3> sorted(std::array<std::uint32_t, 3> corners) {
    std::ranges::sort(corners);
    return corners;
}

std::string find_twins(const Chunk& chunk) {
    using Others = std::array<std::uint32_t, 2>;
    ByVertex<Others> faces(chunk.vertices.size());
    for (const ChunkFace& face : chunk.faces) faces.count(std::ranges::min(face.vertices));
    faces.end_count();
    for (const ChunkFace& face : chunk.faces) {
        const auto [a, b, c] = sorted(face.vertices);
        faces.add(a, {b, c});
    }
    for (std::uint32_t v = 0; v < chunk.vertices.size(); ++v) {
        const std::span<Others> own = faces.of(v);
        std::ranges::sort(own);
        if (std::ranges::adjacent_find(own) != own.end())
            return "two faces have the same corners, near " + text_of(chunk.vertices[v].position);
    }
    return {};
}

/// A face adds the hash of the region on one side of an edge and takes away that on the other: the sum is 0 round an
/// edge where each region ends as often as it begins.
std::string find_open_edge(const Chunk& chunk, std::span<const Label> background, bool is_capped) {
    struct Side {
        std::uint32_t other;
        std::uint64_t hash;
    };
    std::vector<bool> is_active(chunk.vertices.size());
    for (const std::uint32_t v : chunk.active) is_active[v] = true;
    const auto is_looked_at = [&](std::uint32_t a, std::uint32_t b) {
        const int both = chunk.vertices[a].sides & chunk.vertices[b].sides & kBoxSides;
        return !(is_active[a] && is_active[b]) && (is_capped || both == 0);
    };
    const auto hash_of = [&](Label label) {
        const bool is_outside = is_exterior(label) || std::ranges::find(background, label) != background.end();
        return is_outside ? 0 : mix64(label);
    };
    const auto for_edges = [&](const auto& visit) {
        for (const auto& [corners, labels] : chunk.faces)
            for (int n = 0; n < 3; ++n) {
                const std::uint32_t a = corners[n], b = corners[(n + 1) % 3];
                if (is_looked_at(a, b)) visit(a, b, labels);
            }
    };
    ByVertex<Side> edges(chunk.vertices.size());
    for_edges([&](std::uint32_t a, std::uint32_t b, const auto&) { edges.count(std::min(a, b)); });
    edges.end_count();
    for_edges([&](std::uint32_t a, std::uint32_t b, const std::array<Label, 2>& labels) {
        const std::uint64_t hash = hash_of(labels[0]) - hash_of(labels[1]);
        edges.add(std::min(a, b), {std::max(a, b), a < b ? hash : 0 - hash});
    });
    for (std::uint32_t v = 0; v < chunk.vertices.size(); ++v) {
        const std::span<Side> own = edges.of(v);
        std::ranges::sort(own, {}, &Side::other);
        std::uint64_t sum = 0;
        for (std::size_t n = 0; n < own.size(); ++n) {
            sum += own[n].hash;
            if (n + 1 < own.size() && own[n + 1].other == own[n].other) continue;
            if (sum != 0) return "a region is open near " + text_of(chunk.vertices[v].position);
        }
    }
    return {};
}

}  // namespace

std::string misfit_of(const Chunk& chunk, std::span<const Label> background, bool is_capped) {
    const std::string twins = find_twins(chunk);
    return twins.empty() ? find_open_edge(chunk, background, is_capped) : twins;
}

}  // namespace regionmesh
