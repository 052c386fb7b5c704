#include "blocks/quotas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include "blocks/simplify_block.h"

namespace regionmesh {
namespace {

/// The share left at a threshold: between trials a power of it, beyond the last as between the last two, and before the
/// first linear, from all faces at no cost.
double share_at(const PieceHeader& piece, double log_threshold) {
    int count = 0;
    while (count < kMostThresholdTrials && piece.left[count] > 0) ++count;
    if (count == 0) return 1;
    const auto at = [&](int n) { return std::log(trial_threshold(n)); };
    const auto left = [&](int n) { return std::log(std::min(piece.left[n], 1.0)); };
    if (log_threshold <= at(0)) return 1 - (1 - std::exp(left(0))) * std::exp(log_threshold - at(0));
    if (count == 1) return std::exp(left(0));
    int n = 1;
    while (n + 1 < count && at(n) < log_threshold) ++n;
    const double slope = std::min((left(n) - left(n - 1)) / (at(n) - at(n - 1)), 0.0);
    return std::min(std::exp(left(n) + slope * (log_threshold - at(n))), 1.0);
}

double faces_at(std::span<const PieceHeader> pieces, double log_threshold) {
    double sum = 0;
    for (const PieceHeader& piece : pieces) sum += static_cast<double>(piece.faces) * share_at(piece, log_threshold);
    return sum;
}

/// Numbers that rise with the level, 256 for each factor of two.
std::uint64_t rough(double level) { return std::bit_cast<std::uint64_t>(std::max(level, 0.0)) >> 44; }

}  // namespace

double threshold_at(std::span<const PieceHeader> pieces, double target) {
    constexpr int kHalvings = 60;
    double low = std::log(trial_threshold(-kMostThresholdTrials)),
           high = std::log(trial_threshold(2 * kMostThresholdTrials));
    for (int n = 0; n < kHalvings; ++n) {
        const double middle = (low + high) / 2;
        (faces_at(pieces, middle) > target ? low : high) = middle;
    }
    return std::exp(high);
}

std::vector<double> shares_at(std::span<const PieceHeader> pieces, double target) {
    const double threshold = std::log(threshold_at(pieces, target)), all = faces_at(pieces, threshold);
    std::vector<double> shares;
    for (const PieceHeader& piece : pieces)
        shares.push_back(std::min(share_at(piece, threshold) * (all > 0 ? target / all : 1), 1.0));
    return shares;
}

std::vector<std::uint64_t> cut(std::span<const std::filesystem::path> pieces, std::uint64_t faces,
                               std::uint64_t target) {
    // First how many faces go by level, roughly; then level by level where the target is.
    std::map<std::uint64_t, std::uint64_t> removed;
    for (const auto& piece : pieces)
        for (const LoggedCollapse& collapse : read_piece_log(piece)) removed[rough(collapse.level)] += collapse.faces;
    auto last = removed.begin();
    while (last != removed.end() && faces - target > last->second && faces > target) faces -= last++->second;
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
    for (const Next& collapse : next) {
        if (faces <= target) break;
        faces -= collapse.faces;
        ++made[collapse.piece];
    }
    return made;
}

void make_collapses(Piece& piece, std::uint64_t count) {
    const auto made = std::span<const LoggedCollapse>(piece.log).first(count),
               dropped = std::span<const LoggedCollapse>(piece.log).subspan(count);
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
