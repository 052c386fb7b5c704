#include "denoise/kuhn_link.h"

#include <bitset>
#include <cstddef>

namespace regionmesh {
namespace {

constexpr LinkSet kAllNodes = (1 << kLinkSize) - 1;

/// Neighbours of each node within the link: those that a step of the lattice leads to.
constexpr std::array<LinkSet, kLinkSize> kNextTo = [] {
    std::array<LinkSet, kLinkSize> next{};
    for (int a = 0; a < kLinkSize; ++a)
        for (int b = 0; b < kLinkSize; ++b) {
            const LinkStep from = kLinkSteps[a], to = kLinkSteps[b];
            for (const LinkStep step : kLinkSteps)
                if (from.i + step.i == to.i && from.j + step.j == to.j && from.k + step.k == to.k)
                    next[a] |= LinkSet(1 << b);
        }
    return next;
}();

/// The nodes of the part that has the lowest node.
LinkSet first_part(LinkSet nodes) {
    auto part = static_cast<LinkSet>(nodes & -nodes);
    for (LinkSet before = 0; before != part;) {
        before = part;
        for (int n = 0; n < kLinkSize; ++n)
            if (before >> n & 1) part |= kNextTo[n] & nodes;
    }
    return part;
}

std::bitset<1 << kLinkSize> make_table() {
    std::bitset<1 << kLinkSize> table;
    for (int set = 1; set < kAllNodes; ++set) {
        const auto nodes = static_cast<LinkSet>(set), rest = static_cast<LinkSet>(kAllNodes & ~set);
        table[static_cast<std::size_t>(set)] = first_part(nodes) == nodes && first_part(rest) == rest;
    }
    return table;
}

}  // namespace

bool is_contractible(LinkSet nodes) {
    static const std::bitset<1 << kLinkSize> kTable = make_table();
    return kTable[nodes];
}

LinkParts parts_of(LinkSet nodes) {
    LinkParts parts;
    while (nodes) {
        const LinkSet part = first_part(nodes);
        parts.parts[static_cast<std::size_t>(parts.count++)] = part;
        nodes &= static_cast<LinkSet>(~part);
    }
    return parts;
}

bool is_simple(const LinkLabels& link, Label from, Label to) {
    LinkSet own = 0, next = 0;
    std::array<Label, kMostOthers> others{};
    std::array<LinkSet, kMostOthers> sets{};
    int count = 0;
    for (int n = 0; n < kLinkSize; ++n) {
        const Label label = link[static_cast<std::size_t>(n)];
        const auto bit = static_cast<LinkSet>(1 << n);
        if (label == from) {
            own |= bit;
        } else if (label == to) {
            next |= bit;
        } else {
            int other = 0;
            while (other < count && others[static_cast<std::size_t>(other)] != label) ++other;
            if (other == kMostOthers) return false;
            if (other == count) others[static_cast<std::size_t>(count++)] = label;
            sets[static_cast<std::size_t>(other)] |= bit;
        }
    }
    for (unsigned chosen = 0; chosen < 1u << count; ++chosen) {
        LinkSet more = 0;
        for (int other = 0; other < count; ++other)
            if (chosen >> other & 1) more |= sets[static_cast<std::size_t>(other)];
        if (!is_contractible(own | more) || !is_contractible(next | more)) return false;
    }
    return true;
}

}  // namespace regionmesh
