#include "denoise/kuhn_link.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "cells/kuhn.h"

namespace regionmesh {
namespace {

bool are_neighbours(LinkStep a, LinkStep b) {
    return std::ranges::any_of(
        kLinkSteps, [&](LinkStep step) { return a.i + step.i == b.i && a.j + step.j == b.j && a.k + step.k == b.k; });
}

/// Parts of a set of nodes, and nodes - edges + triangles of its full subcomplex of the link.
struct LinkCounts {
    int parts = 0, euler = 0;
};

LinkCounts count_link(LinkSet nodes) {
    LinkCounts counts;
    std::vector<int> members, part;
    for (int n = 0; n < kLinkSize; ++n)
        if (nodes >> n & 1) members.push_back(n);
    std::set<int> left(members.begin(), members.end());
    while (!left.empty()) {
        ++counts.parts;
        part = {*left.begin()};
        left.erase(left.begin());
        for (std::size_t n = 0; n < part.size(); ++n)
            for (const int other : members)
                if (left.contains(other) && are_neighbours(kLinkSteps[part[n]], kLinkSteps[other])) {
                    part.push_back(other);
                    left.erase(other);
                }
    }
    counts.euler = static_cast<int>(members.size());
    for (const int a : members)
        for (const int b : members)
            for (const int c : members) {
                const bool ab = a < b && are_neighbours(kLinkSteps[a], kLinkSteps[b]);
                if (ab && c == a) --counts.euler;
                if (ab && b < c && are_neighbours(kLinkSteps[a], kLinkSteps[c]) &&
                    are_neighbours(kLinkSteps[b], kLinkSteps[c]))
                    ++counts.euler;
            }
    return counts;
}

TEST(KuhnLink, is_a_sphere_of_14_nodes_and_24_triangles) {
    const LinkCounts counts = count_link((1 << kLinkSize) - 1);
    EXPECT_EQ(counts.parts, 1);
    EXPECT_EQ(counts.euler, 2);
}

TEST(KuhnLink, contracts_every_set_that_is_one_part_without_a_hole) {
    for (int set = 0; set < 1 << kLinkSize; ++set) {
        const auto nodes = static_cast<LinkSet>(set);
        const LinkCounts counts = count_link(nodes);
        ASSERT_EQ(is_contractible(nodes), counts.parts == 1 && counts.euler == 1) << set;
        ASSERT_EQ(parts_of(nodes).count, counts.parts) << set;
    }
}

/// A block of 3 x 3 x 3 samples in one of 5 x 5 x 5.
class Block {
public:
    explicit Block(std::mt19937& random, Label count) {
        std::uniform_int_distribution<Label> label(0, count - 1);
        for (Label& sample : labels_) sample = label(random);
    }
    Label& at(int i, int j, int k) { return labels_[static_cast<std::size_t>((k + 2) * 25 + (j + 2) * 5 + i + 2)]; }
    LinkLabels link() {
        LinkLabels link;
        for (std::size_t n = 0; n < kLinkSize; ++n) link[n] = at(kLinkSteps[n].i, kLinkSteps[n].j, kLinkSteps[n].k);
        return link;
    }

    /// Euler characteristic and number of parts of each union of regions; quadruple points; pairs with an interface.
    std::vector<std::int64_t> counts(Label label_count) {
        std::vector<std::int64_t> all;
        std::set<std::pair<Label, Label>> pairs;
        std::int64_t quadruple = 0;
        for (unsigned chosen = 0; chosen < 1u << label_count; ++chosen) {
            std::int64_t euler = 0;
            for_simplices([&](const std::vector<Label>& corners) {
                const std::set<Label> different(corners.begin(), corners.end());
                if (std::ranges::all_of(corners, [&](Label label) { return chosen >> label & 1; }))
                    euler += corners.size() % 2 == 1 ? 1 : -1;
                if (chosen != 0) return;
                if (corners.size() == 2 && different.size() == 2)
                    pairs.emplace(*different.begin(), *different.rbegin());
                quadruple += different.size() == 4;
            });
            all.push_back(euler);
            all.push_back(parts(chosen));
        }
        all.push_back(quadruple);
        for (const auto& [a, b] : pairs) all.push_back(a * label_count + b);
        return all;
    }

private:
    template <class Visit>
    void for_simplices(Visit&& visit) {
        for (int k = -2; k <= 2; ++k)
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i)
                    for (const SimplexKind& kind : kKinds) {
                        std::vector<Label> corners;
                        for (int n = 0; n < kind.node_count; ++n) {
                            const Step step = kind.steps[static_cast<std::size_t>(n)];
                            const int x = i + (step & 1), y = j + (step >> 1 & 1), z = k + (step >> 2);
                            if (std::max({x, y, z}) > 2) break;
                            corners.push_back(at(x, y, z));
                        }
                        if (corners.size() == static_cast<std::size_t>(kind.node_count)) visit(corners);
                    }
    }

    std::int64_t parts(unsigned chosen) {
        std::set<std::array<int, 3>> left;
        for (int k = -2; k <= 2; ++k)
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i)
                    if (chosen >> at(i, j, k) & 1) left.insert({i, j, k});
        std::int64_t count = 0;
        while (!left.empty()) {
            ++count;
            std::vector<std::array<int, 3>> part{*left.begin()};
            left.erase(left.begin());
            for (std::size_t n = 0; n < part.size(); ++n)
                for (const LinkStep step : kLinkSteps) {
                    const auto from = part[n];
                    const auto found = left.find({from[0] + step.i, from[1] + step.j, from[2] + step.k});
                    if (found == left.end()) continue;
                    part.push_back(*found);
                    left.erase(found);
                }
        }
        return count;
    }

    std::array<Label, 125> labels_;
};

TEST(KuhnLink, changes_simple_samples_without_a_change_of_topology) {
    std::mt19937 random(5);
    std::map<Label, int> simple;  // by number of labels
    for (int n = 0; n < 2400; ++n) {
        const Label count = 2 + n % 4;
        Block block(random, count);
        const Label from = block.at(0, 0, 0), to = (from + 1 + static_cast<Label>(n / 4) % (count - 1)) % count;
        const bool is_free = is_simple(block.link(), from, to);
        const auto before = block.counts(count);
        block.at(0, 0, 0) = to;
        const bool is_same = before == block.counts(count);
        EXPECT_TRUE(is_same || !is_free) << n;
        simple[count] += is_free;
    }
    for (const auto& [count, found] : simple) EXPECT_GT(found, count < 5 ? 2 : -1) << count;
}

TEST(KuhnLink, keeps_samples_that_close_a_hole_join_parts_or_are_alone) {
    LinkLabels link;
    link.fill(1);
    EXPECT_FALSE(is_simple(link, 0, 1)) << "a region of one sample";
    EXPECT_FALSE(is_simple(link, 1, 0)) << "would begin a region";
    link[0] = link[7] = 0;  // on both sides along x
    EXPECT_FALSE(is_simple(link, 1, 0)) << "joins two parts";
    EXPECT_FALSE(is_simple(link, 0, 1)) << "parts a thread";
    link.fill(1);
    for (const std::size_t n : {0, 1, 2}) link[n] = 0;
    link[0] = kOutside;
    EXPECT_FALSE(is_simple(link, 0, 2)) << "a label that no neighbour has";
}

}  // namespace
}  // namespace regionmesh
