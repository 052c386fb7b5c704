#include "compare/strata_tree.h"

#include <algorithm>

#include "base/parallel_for.h"
#include "base/radix_sort.h"
#include "compare/distance.h"
#include "compare/hilbert.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kFan = EightBoxes::kCount, kRun = kFan * kFan;
constexpr std::uint32_t kRunsPerTask = 1024;
constexpr float kMargin = 0x1p-22f;  // margin of boxes, in half extents: exceeds the rounding of single precision

}  // namespace

StrataTree::StrataTree(const SortedStrata& sorted, std::uint32_t threads) : sorted_(sorted) {
    if (sorted.simplices.empty()) return;
    middle_ = 0.5 * (sorted.bounds.low + sorted.bounds.high);
    const Vec3 half = sorted.bounds.high - middle_;
    const double longest = std::max({half.x, half.y, half.z});
    if (longest > 0) scale_ = 1 / longest;
    make_runs();
    parallel_for(static_cast<std::uint32_t>((runs_.size() + kRunsPerTask - 1) / kRunsPerTask), threads,
                 [&](std::uint32_t task) {
                     const std::size_t end = std::min(runs_.size(), (std::size_t{task} + 1) * kRunsPerTask);
                     for (std::size_t n = std::size_t{task} * kRunsPerTask; n < end; ++n) put_boxes(runs_[n]);
                 });
    make_trees();
}

void StrataTree::make_runs() {
    std::uint32_t blocks = 0;
    for (std::uint32_t s = 0; s < sorted_.strata.size(); ++s) {
        const Stratum& stratum = sorted_.strata[s];
        for (std::uint32_t first = stratum.begin; first < stratum.end; first += kRun) {
            runs_.push_back({first, blocks, s, {}});
            blocks += (std::min(kRun, stratum.end - first) + kFan - 1) / kFan;
        }
    }
    blocks_.resize(blocks);
}

void StrataTree::put_boxes(Run& run) {
    const std::uint32_t count = std::min(kRun, sorted_.strata[run.stratum].end - run.first_simplex);
    for (std::uint32_t n = 0; n < count; ++n)
        blocks_[run.first_block + n / kFan].put(n % kFan, outward(sorted_.simplices[run.first_simplex + n]));
    for (std::uint32_t block = 0; block * kFan < count; ++block)
        run.blocks.put(block, blocks_[run.first_block + block].hull());
}

void StrataTree::make_trees() {
    const HilbertGrid grid(sorted_.bounds);
    std::vector<KeyedIndex> order;
    std::vector<FloatBox> hulls;
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
        hulls.push_back(runs_[r].blocks.hull());
        const FloatBox& hull = hulls.back();
        const Vec3 sum{double{hull.low[0]} + hull.high[0], double{hull.low[1]} + hull.high[1],
                       double{hull.low[2]} + hull.high[2]};
        order.push_back({grid.key(middle_ + 0.5 / scale_ * sum), r});
    }
    radix_sort(order);
    // Runs along the curve: all, by label, by stratum.
    std::vector<std::uint32_t> all;
    std::vector<std::vector<std::uint32_t>> of_label, of_stratum(sorted_.strata.size());
    for (const KeyedIndex& item : order) {
        const std::uint32_t stratum = runs_[item.index].stratum;
        all.push_back(item.index);
        of_stratum[stratum].push_back(item.index);
        for (const Label label : sorted_.strata[stratum].labels) {
            if (is_exterior(label)) continue;
            if (label >= of_label.size()) of_label.resize(label + 1);
            of_label[label].push_back(item.index);
        }
    }
    const auto tree_of = [&](std::vector<std::uint32_t>& names) {
        std::vector<FloatBox> boxes;
        for (const std::uint32_t name : names) boxes.push_back(hulls[name]);
        return BoxTree(boxes, std::move(names));
    };
    all_ = tree_of(all);
    for (auto& names : of_label) by_label_.push_back(tree_of(names));
    for (auto& names : of_stratum) by_stratum_.push_back(tree_of(names));
}

FloatPoint StrataTree::to_frame(Vec3 p) const {
    const Vec3 d = scale_ * (p - middle_);
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

/// A bound on squared distances to boxes that allows for the rounding of single precision.
float StrataTree::limit_of(double squared) const { return static_cast<float>(squared * scale_ * scale_ * (1 + 4e-6)); }

FloatBox StrataTree::outward(const Simplex& s) const {
    Box box;
    for (const std::uint32_t v : s) box.add(sorted_.points[v]);
    FloatBox result{to_frame(box.low), to_frame(box.high)};
    for (int axis = 0; axis < 3; ++axis) {
        result.low[axis] -= kMargin;
        result.high[axis] += kMargin;
    }
    return result;
}

double StrataTree::squared_distance_to(Vec3 p, std::uint32_t simplex, double bound) const {
    const Simplex& s = sorted_.simplices[simplex];
    const Vec3 a = sorted_.points[s[0]], b = sorted_.points[s[1]];
    return is_edge(s) ? squared_distance(p, a, b) : squared_distance(p, {a, b, sorted_.points[s[2]]}, bound);
}

void StrataTree::look_into(const Run& run, Vec3 p, const FloatPoint& in_frame, Nearest& found, float& limit) const {
    std::array<NearBox, kFan> blocks, simplices;
    const std::uint32_t block_count = near_boxes(run.blocks, in_frame, limit, blocks);
    for (std::uint32_t b = 0; b < block_count && blocks[b].squared < limit; ++b) {
        const std::uint32_t block = blocks[b].lane;
        const std::uint32_t count = near_boxes(blocks_[run.first_block + block], in_frame, limit, simplices);
        for (std::uint32_t n = 0; n < count && simplices[n].squared < limit; ++n) {
            const std::uint32_t simplex = run.first_simplex + block * kFan + simplices[n].lane;
            const double squared = squared_distance_to(p, simplex, found.squared);
            if (squared >= found.squared) continue;
            found = {squared, simplex, run.stratum};
            limit = limit_of(squared);
        }
    }
}

Nearest StrataTree::search(const BoxTree& tree, Vec3 p, Nearest found) const {
    const FloatPoint in_frame = to_frame(p);
    float limit = limit_of(found.squared);
    tree.search(in_frame, limit, [&](std::uint32_t run) { look_into(runs_[run], p, in_frame, found, limit); });
    return found;
}

Nearest StrataTree::nearest(Vec3 p, const Nearest& guess, double below) const {
    Nearest first{.squared = below};
    if (guess.simplex != kNoSimplex)
        if (const double squared = squared_distance_to(p, guess.simplex, HUGE_VAL); squared < below)
            first = {squared, guess.simplex, guess.stratum};
    return search(all_, p, first);
}

Nearest StrataTree::nearest_of_label(Vec3 p, Label label, double below) const {
    const Nearest none{.squared = below};
    return has_label(label) ? search(by_label_[label], p, none) : none;
}

Nearest StrataTree::nearest_of_stratum(Vec3 p, std::uint32_t stratum, double below) const {
    const Nearest none{.squared = below};
    return stratum < by_stratum_.size() ? search(by_stratum_[stratum], p, none) : none;
}

}  // namespace regionmesh
