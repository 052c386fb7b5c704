// Sections between two sections, from the shapes of their parts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/label.h"
#include "volume/distance_field.h"
#include "volume/section_parts.h"

namespace regionmesh {

/// What two sections look like, and the cells between them.
struct Gap {
    std::int32_t width = 0, height = 0;
    std::uint32_t steps = 2;  // one more than the sections between
    SectionStep step = {};    // between samples of a section; the smaller is 1
    float distance = 0;       // between the two sections, in the same unit

    std::size_t samples() const { return std::size_t(width) * std::size_t(height); }
    std::uint32_t between() const { return steps - 1; }
};

/// How parts are matched over a gap of this distance.
MatchOptions match_options(const Gap& gap);

/// Fills the sections between two. Guarantees:
///   - a sample has a label that one of the two sections has;
///   - every part of a label in the gap, connected as in the mesh, reaches one of the two sections: no part and no
///     cavity appears that no section shows.
/// Does not guarantee that parts stay apart which a section between would show apart.
///
/// Each group of overlapping parts is a field of signed distances, interpolated linearly, along the motion of its
/// centroid where that makes a pair of parts overlap more; the largest field wins. Parts that overlap nothing, and
/// match one of the other section, lie above these fields and move from one place to the other; what they leave is
/// filled by their neighbours. Other parts end halfway. Deterministic; `threads` does not change the result.
class GapFiller {
public:
    explicit GapFiller(std::uint32_t threads) : threads_(threads) {}

    void fill(const Gap& gap, std::span<const InputLabel> low, std::span<const InputLabel> high);

    /// Section n, from 0, of those between.
    void copy(std::uint32_t n, std::span<InputLabel> section) const;

    /// Bytes that fill() holds.
    static std::uint64_t bytes(const Gap& gap);

private:
    struct Group;

    std::vector<Group> groups_of(const SectionParts& low, const SectionParts& high, const PartMatch& match);
    void put(const Group& group);
    void put_end(const Group& group);
    void put_pair(const Group& group);
    void move(const SectionParts& low, const SectionParts& high, std::uint32_t a, std::uint32_t b);
    void find_labels(const SectionParts& low, const SectionParts& high);
    std::uint32_t index_of(InputLabel label) const;

    template <class Value>
    void put_values(const SectionBox& box, std::uint32_t label, Value&& value);

    std::uint32_t threads_;
    Gap gap_ = {};
    float cap_ = 0;                          // of fields
    std::vector<InputLabel> labels_;         // of both sections, sorted as numbers
    std::vector<std::uint32_t> low_, high_;  // group of each sample
    DistanceField a_, b_;
    std::vector<std::uint8_t> inside_;
    std::vector<std::vector<float>> best_;           // largest field, by section between
    std::vector<std::vector<std::uint32_t>> layer_;  // index of its label; the first and the last are the sections
};

}  // namespace regionmesh
