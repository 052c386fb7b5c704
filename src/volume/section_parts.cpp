#include "volume/section_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace regionmesh {
namespace {

/// Parts of a like size: the larger has at most this many times the samples of the smaller.
constexpr std::uint64_t kLikeSize = 4;

/// Overlap as a share of the union: below the first it is little, and a gain of the second is much.
constexpr double kLittleOverlap = 0.4, kFarMore = 0.3;

class Joined {
public:
    explicit Joined(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t n) {
        while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
        return n;
    }
    /// The smaller number becomes the root.
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

using Samples = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Samples of a part with a neighbour outside it, or at the side of the section.
Samples outline(const SectionParts& section, std::uint32_t part) {
    const auto height = static_cast<std::int32_t>(section.number.size() / std::size_t(section.width));
    const auto is_own = [&](std::int32_t x, std::int32_t y) {
        return x >= 0 && y >= 0 && x < section.width && y < height &&
               section.number[std::size_t(y) * std::size_t(section.width) + std::size_t(x)] == part;
    };
    Samples samples;
    const SectionBox& box = section.parts[part].box;
    for (std::int32_t y = box.y0; y < box.y1; ++y)
        for (std::int32_t x = box.x0; x < box.x1; ++x)
            if (is_own(x, y) && !(is_own(x - 1, y) && is_own(x + 1, y) && is_own(x, y - 1) && is_own(x, y + 1)))
                samples.emplace_back(x, y);
    return samples;
}

float gap_between(std::int32_t a0, std::int32_t a1, std::int32_t b0, std::int32_t b1) {
    return static_cast<float>(std::max({0, b0 - a1 + 1, a0 - b1 + 1}));
}

/// Distances between the outlines of parts of two sections.
class PartDistances {
public:
    PartDistances(const SectionParts& low, const SectionParts& high, SectionStep step)
        : low_(low), high_(high), step_(step) {}

    /// None if it is more than `reach`.
    std::optional<float> operator()(std::uint32_t a, std::uint32_t b, float reach) {
        const SectionBox &one = low_.parts[a].box, &two = high_.parts[b].box;
        const float x = gap_between(one.x0, one.x1, two.x0, two.x1) * step_.x;
        const float y = gap_between(one.y0, one.y1, two.y0, two.y1) * step_.y;
        if (std::hypot(x, y) > reach) return {};
        float best = reach * reach;
        bool is_near = false;
        for (const auto& [i, j] : outline_of(low_outlines_, low_, a)) {
            const float near_x = gap_between(i, i + 1, two.x0, two.x1) * step_.x;
            const float near_y = gap_between(j, j + 1, two.y0, two.y1) * step_.y;
            if (near_x * near_x + near_y * near_y > best) continue;
            for (const auto& [k, l] : outline_of(high_outlines_, high_, b)) {
                const float u = static_cast<float>(k - i) * step_.x, v = static_cast<float>(l - j) * step_.y;
                if (u * u + v * v > best) continue;
                best = u * u + v * v;
                is_near = true;
            }
        }
        return is_near ? std::optional(std::sqrt(best)) : std::nullopt;
    }

private:
    using Outlines = std::map<std::uint32_t, Samples>;
    static const Samples& outline_of(Outlines& known, const SectionParts& section, std::uint32_t part) {
        const auto [at, is_new] = known.try_emplace(part);
        if (is_new) at->second = outline(section, part);
        return at->second;
    }

    const SectionParts &low_, &high_;
    SectionStep step_;
    Outlines low_outlines_, high_outlines_;
};

bool are_of_like_size(const SectionPart& a, const SectionPart& b) {
    return std::max(a.samples, b.samples) <= kLikeSize * std::min(a.samples, b.samples);
}

/// Pairs of parts with the same label that share samples, each once, in order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> overlapping(const SectionParts& low, const SectionParts& high) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    std::pair<std::uint32_t, std::uint32_t> last{PartMatch::kMoves, PartMatch::kMoves};
    for (std::size_t n = 0; n < low.number.size(); ++n) {
        const std::pair pair{low.number[n], high.number[n]};
        if (pair == last || low.parts[pair.first].label != high.parts[pair.second].label) continue;
        pairs.push_back(pair);
        last = pair;
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// Samples that two parts share once the first is moved by whole samples.
std::uint64_t shared_samples(const SectionParts& low, std::uint32_t a, const SectionParts& high, std::uint32_t b,
                             std::int32_t dx, std::int32_t dy) {
    const auto row = static_cast<std::int64_t>(low.width);
    const auto height = static_cast<std::int32_t>(low.number.size() / std::size_t(low.width));
    const SectionBox& box = low.parts[a].box;
    std::uint64_t shared = 0;
    for (std::int32_t y = std::max(box.y0, -dy); y < std::min(box.y1, height - dy); ++y)
        for (std::int32_t x = std::max(box.x0, -dx); x < std::min(box.x1, low.width - dx); ++x)
            shared += low.number[y * row + x] == a && high.number[(y + dy) * row + x + dx] == b;
    return shared;
}

/// Whether two parts share little where they are, and far more once their centroids are brought together.
bool moves_over(const SectionParts& low, std::uint32_t a, const SectionParts& high, std::uint32_t b) {
    const SectionPart &one = low.parts[a], &two = high.parts[b];
    const auto mean = [](std::uint64_t sum, std::uint64_t count) { return double(sum) / double(count); };
    const auto dx = std::lround(mean(two.sum_x, two.samples) - mean(one.sum_x, one.samples));
    const auto dy = std::lround(mean(two.sum_y, two.samples) - mean(one.sum_y, one.samples));
    if (dx == 0 && dy == 0) return false;
    const auto share = [&](long x, long y) {
        const auto shared =
            double(shared_samples(low, a, high, b, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)));
        return shared / (double(one.samples + two.samples) - shared);
    };
    const double still = share(0, 0);
    return still < kLittleOverlap && share(dx, dy) > still + kFarMore;
}

/// Parts of two sections that may be one, although they do not overlap; the nearest first.
struct Candidate {
    bool is_branch;  // one of them overlaps another part
    float far;
    std::uint32_t low, high;
    friend bool operator<(const Candidate& a, const Candidate& b) {
        return std::tie(a.is_branch, a.far, a.low, a.high) < std::tie(b.is_branch, b.far, b.low, b.high);
    }
};

std::vector<Candidate> find_candidates(const SectionParts& low, const SectionParts& high,
                                       const std::vector<bool>& low_overlaps, const std::vector<bool>& high_overlaps,
                                       const MatchOptions& options) {
    std::multimap<InputLabel, std::uint32_t> by_label;
    for (std::uint32_t b = 0; b < high.parts.size(); ++b) by_label.emplace(high.parts[b].label, b);
    PartDistances distance(low, high, options.step);
    std::vector<Candidate> found;
    for (std::uint32_t a = 0; a < low.parts.size(); ++a) {
        const auto [first, last] = by_label.equal_range(low.parts[a].label);
        for (auto at = first; at != last; ++at) {
            const std::uint32_t b = at->second;
            if (low_overlaps[a] && high_overlaps[b]) continue;
            if (!are_of_like_size(low.parts[a], high.parts[b])) continue;
            const bool is_branch = low_overlaps[a] || high_overlaps[b];
            if (const auto far = distance(a, b, is_branch ? options.branch_reach : options.reach))
                found.push_back({is_branch, *far, a, b});
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

SectionParts find_parts(std::span<const InputLabel> section, std::int32_t width) {
    SectionParts found{.width = width, .number = std::vector<std::uint32_t>(section.size()), .parts = {}};
    Joined joined(section.size());
    const auto row = static_cast<std::size_t>(width);
    for (std::size_t n = 0; n < section.size(); ++n) {
        const auto join = [&](std::size_t other) {
            if (section[other] == section[n])
                joined.join(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(other));
        };
        const bool has_left = n % row > 0, has_right = (n + 1) % row > 0;
        if (has_left) join(n - 1);
        if (n < row) continue;
        join(n - row);
        if (has_left) join(n - row - 1);
        if (has_right) join(n - row + 1);
    }
    for (std::size_t n = 0; n < section.size(); ++n) {
        const std::uint32_t root = joined.root(static_cast<std::uint32_t>(n));
        if (root == n) {  // the first sample of its part
            found.number[n] = static_cast<std::uint32_t>(found.parts.size());
            found.parts.push_back({.label = section[n]});
        } else {
            found.number[n] = found.number[root];
        }
        SectionPart& part = found.parts[found.number[n]];
        ++part.samples;
        part.sum_x += n % row;
        part.sum_y += n / row;
        part.box.add(static_cast<std::int32_t>(n % row), static_cast<std::int32_t>(n / row));
    }
    return found;
}

PartMatch match_parts(const SectionParts& low, const SectionParts& high, const MatchOptions& options) {
    const auto low_count = static_cast<std::uint32_t>(low.parts.size());
    const auto count = static_cast<std::uint32_t>(low.parts.size() + high.parts.size());
    PartMatch match;
    Joined joined(count);
    std::vector<bool> low_overlaps(low.parts.size()), high_overlaps(high.parts.size());
    const auto pairs = overlapping(low, high);
    std::vector<std::uint32_t> low_pairs(low.parts.size()), high_pairs(high.parts.size());
    for (const auto& [a, b] : pairs) {
        joined.join(a, low_count + b);
        low_overlaps[a] = high_overlaps[b] = true;
        ++low_pairs[a];
        ++high_pairs[b];
        ++match.overlaps;
    }
    std::vector<bool> low_moves(low.parts.size()), high_moves(high.parts.size());
    for (const auto& [a, b] : pairs)
        if (low_pairs[a] == 1 && high_pairs[b] == 1 && moves_over(low, a, high, b)) {
            low_moves[a] = high_moves[b] = true;
            match.moves.emplace_back(a, b);
        }
    for (const Candidate& pair : find_candidates(low, high, low_overlaps, high_overlaps, options)) {
        if (low_moves[pair.low] || high_moves[pair.high]) continue;
        // The part that overlaps another goes on there, and is not used up.
        if (!low_overlaps[pair.low]) low_moves[pair.low] = true;
        if (!high_overlaps[pair.high]) high_moves[pair.high] = true;
        match.moves.emplace_back(pair.low, pair.high);
        ++match.apart;
    }
    std::vector<std::uint32_t> group(count, PartMatch::kMoves);
    const auto group_of = [&](std::uint32_t part) {
        std::uint32_t& own = group[joined.root(part)];
        if (own == PartMatch::kMoves) own = match.groups++;
        return own;
    };
    for (std::uint32_t a = 0; a < low_count; ++a) match.low.push_back(low_moves[a] ? PartMatch::kMoves : group_of(a));
    for (std::uint32_t b = 0; b < high.parts.size(); ++b)
        match.high.push_back(high_moves[b] ? PartMatch::kMoves : group_of(low_count + b));
    return match;
}

}  // namespace regionmesh
