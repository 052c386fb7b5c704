#include "blocks/cut.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>

namespace regionmesh {
namespace {

/// Numbers that rise with the level, 256 for each factor of two.
std::uint64_t rough(double level) { return std::bit_cast<std::uint64_t>(std::max(level, 0.0)) >> 44; }

}  // namespace

std::vector<std::uint64_t> cut(std::span<const std::filesystem::path> pieces, std::uint64_t faces,
                               std::uint64_t target) {
    // First how many faces go by level, roughly; then level by level where the target is.
    std::map<std::uint64_t, std::uint64_t> removed;
    for (const auto& piece : pieces)
        for (const LoggedCollapse& collapse : read_piece_log(piece)) removed[rough(collapse.level)] += collapse.faces;
    auto last = removed.begin();
    while (last != removed.end() && faces > target + last->second) faces -= last++->second;
    std::vector<std::uint64_t> made(pieces.size());
    struct Next {
        double level;
        std::uint32_t piece, faces;
    };
    std::vector<Next> next;
    for (std::uint32_t n = 0; n < pieces.size(); ++n)
        for (const LoggedCollapse& collapse : read_piece_log(pieces[n])) {
            if (last == removed.end() || rough(collapse.level) < last->first)
                ++made[n];
            else if (rough(collapse.level) == last->first)
                next.push_back({collapse.level, n, collapse.faces});
        }
    std::ranges::stable_sort(next, {}, &Next::level);
    auto at = next.begin();
    for (; at != next.end() && faces >= target + at->faces; ++at) {
        faces -= at->faces;
        ++made[at->piece];
    }
    if (at == next.end() || faces <= target) return made;
    // Of the next ones of all logs, that which leaves the least below the target.
    std::set<std::uint32_t> seen;
    auto last_made = at;
    for (; at != next.end(); ++at)
        if (seen.insert(at->piece).second && faces <= target + at->faces && at->faces < last_made->faces)
            last_made = at;
    ++made[last_made->piece];
    return made;
}

void make_collapses(Piece& piece, std::uint64_t count) {
    const std::span<const LoggedCollapse> log = piece.log;
    const auto made = log.first(std::min<std::uint64_t>(count, log.size())), dropped = log.subspan(made.size());
    for (auto at = dropped.rbegin(); at != dropped.rend(); ++at) {
        piece.vertices[at->goes].error_bound = at->goes_bound;
        piece.vertices[at->stays].error_bound = at->stays_bound;
    }
    // Where a vertex leads to in the end: a chain of collapses is followed from its end.
    std::vector<std::uint32_t> into(piece.vertices.size());
    std::iota(into.begin(), into.end(), 0);
    for (const LoggedCollapse& collapse : made) piece.vertices[collapse.stays].position = collapse.position;
    for (auto at = made.rbegin(); at != made.rend(); ++at) into[at->goes] = into[at->stays];
    std::erase_if(piece.faces, [&](PieceFace& face) {
        for (std::uint32_t& v : face.vertices) v = into[v];
        const auto& [a, b, c] = face.vertices;
        return a == b || b == c || c == a;
    });
    std::uint32_t left = 0;
    for (std::uint32_t v = 0; v < into.size(); ++v) {
        if (into[v] != v) continue;
        piece.vertices[left] = piece.vertices[v];
        into[v] = left++;
    }
    piece.vertices.resize(left);
    for (PieceFace& face : piece.faces)
        for (std::uint32_t& v : face.vertices) v = into[v];
    piece.log.clear();
}

}  // namespace regionmesh
