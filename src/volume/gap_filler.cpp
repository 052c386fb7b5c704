#include "volume/gap_filler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel_for.h"
#include "volume/loose_parts.h"

namespace regionmesh {
namespace {

constexpr float kLeastCap = 3;       // of fields, in steps: thinner ones say too little about shape
constexpr int kPasses = 1;           // of smoothing of fields: more shrink thin parts
constexpr float kReach = 2;          // parts that overlap nothing are matched up to this slope
constexpr float kBranchReach = 0.5;  // and with parts that overlap another
constexpr float kGain = 0.02F;       // overlap that a motion must win, as a share of the union, for each step of it
constexpr float kMoving = 1e6F;      // added to fields of parts that move: they lie above all others
constexpr std::size_t kFewestInParallel = 1 << 14;  // samples of a box

struct Motion {
    float x = 0, y = 0;
    bool is_none() const { return x == 0 && y == 0; }
};

/// Samples that two sets share when the first is moved.
std::uint64_t moved_overlap(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                            const SectionBox& box, Motion motion) {
    const auto dx = static_cast<std::int32_t>(std::lround(motion.x)),
               dy = static_cast<std::int32_t>(std::lround(motion.y));
    std::uint64_t shared = 0;
    for (std::int32_t y = 0; y < box.height(); ++y)
        for (std::int32_t x = 0; x < box.width(); ++x) {
            const std::int32_t u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= box.width() || v >= box.height()) continue;
            shared += a[std::size_t(y) * std::size_t(box.width()) + std::size_t(x)] &&
                      b[std::size_t(v) * std::size_t(box.width()) + std::size_t(u)];
        }
    return shared;
}

std::uint64_t size_of(const std::vector<std::uint8_t>& set) { return std::uint64_t(std::ranges::count(set, 1)); }

Motion centroid(const std::vector<std::uint8_t>& set, const SectionBox& box) {
    double x = 0, y = 0, count = 0;
    for (std::int32_t j = 0; j < box.height(); ++j)
        for (std::int32_t i = 0; i < box.width(); ++i)
            if (set[std::size_t(j) * std::size_t(box.width()) + std::size_t(i)]) x += i, y += j, ++count;
    return {static_cast<float>(x / count), static_cast<float>(y / count)};
}

/// The sample farthest inside.
Motion deepest(const DistanceField& field) {
    const auto at = std::ranges::max_element(field.values) - field.values.begin();
    return {static_cast<float>(at % field.box.width()), static_cast<float>(at / field.box.width())};
}

Motion operator-(Motion a, Motion b) { return {a.x - b.x, a.y - b.y}; }

/// A part between two sections, the share `t` of the way from one to the other.
float moved_field(const DistanceField& a, const DistanceField& b, Motion motion, float t, float x, float y) {
    return (1 - t) * a.at(x - t * motion.x, y - t * motion.y) +
           t * b.at(x + (1 - t) * motion.x, y + (1 - t) * motion.y);
}

/// Gives samples without a group that of a neighbour in the section, the nearest first.
void spread_groups(std::vector<std::uint32_t>& group, std::int32_t width) {
    std::vector<std::size_t> left;
    for (std::size_t n = 0; n < group.size(); ++n)
        if (group[n] == PartMatch::kMoves) left.push_back(n);
    const auto row = static_cast<std::size_t>(width);
    std::vector<std::pair<std::size_t, std::uint32_t>> found;
    while (!left.empty()) {
        found.clear();
        std::erase_if(left, [&](std::size_t n) {
            std::uint32_t near = PartMatch::kMoves;
            const auto look = [&](bool is_there, std::size_t other) {
                if (is_there && near == PartMatch::kMoves) near = group[other];
            };
            look(n % row > 0, n - 1);
            look((n + 1) % row > 0, n + 1);
            look(n >= row, n - row);
            look(n + row < group.size(), n + row);
            if (near == PartMatch::kMoves) return false;
            found.emplace_back(n, near);
            return true;
        });
        if (found.empty()) return;  // every part moves
        for (const auto& [n, own] : found) group[n] = own;
    }
}

}  // namespace

/// Parts that overlap, or one that ends.
struct GapFiller::Group {
    std::uint32_t number = 0, label = 0;
    SectionBox box = {};
    std::uint64_t low = 0, high = 0;  // samples
    std::uint32_t parts = 0;          // in both sections
};

MatchOptions match_options(const Gap& gap) {
    return {.step = gap.step, .reach = kReach * gap.distance, .branch_reach = kBranchReach * gap.distance};
}

std::uint64_t GapFiller::bytes(const Gap& gap) {
    constexpr std::uint64_t kPerLayer = sizeof(float) + 2 * sizeof(std::uint32_t);
    constexpr std::uint64_t kPerSample = 2 * sizeof(InputLabel) + 8 * sizeof(std::uint32_t) + 3 * sizeof(float);
    return gap.samples() * ((gap.steps + 1) * kPerLayer + kPerSample);
}

std::uint32_t GapFiller::index_of(InputLabel label) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(labels_, label) - labels_.begin());
}

void GapFiller::find_labels(const SectionParts& low, const SectionParts& high) {
    labels_.clear();
    for (const SectionParts* section : {&low, &high})
        for (const SectionPart& part : section->parts) labels_.push_back(part.label);
    std::ranges::sort(labels_);
    labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
    layer_.resize(gap_.steps + 1);
    for (auto& layer : layer_) layer.resize(gap_.samples());
    for (const auto& [section, layer] : {std::pair{&low, &layer_.front()}, {&high, &layer_.back()}}) {
        std::vector<std::uint32_t> index;
        for (const SectionPart& part : section->parts) index.push_back(index_of(part.label));
        for (std::size_t n = 0; n < layer->size(); ++n) (*layer)[n] = index[section->number[n]];
    }
}

std::vector<GapFiller::Group> GapFiller::groups_of(const SectionParts& low, const SectionParts& high,
                                                   const PartMatch& match) {
    std::vector<Group> groups(match.groups);
    const auto assign = [&](const SectionParts& section, const std::vector<std::uint32_t>& group_of_part,
                            std::vector<std::uint32_t>& out, std::uint64_t Group::*samples) {
        for (std::size_t part = 0; part < section.parts.size(); ++part) {
            if (group_of_part[part] == PartMatch::kMoves) continue;
            Group& group = groups[group_of_part[part]];
            group.label = index_of(section.parts[part].label);
            ++group.parts;
        }
        out.resize(section.number.size());
        for (std::size_t n = 0; n < out.size(); ++n) out[n] = group_of_part[section.number[n]];
        spread_groups(out, gap_.width);
        for (std::size_t n = 0; n < out.size(); ++n) {
            if (out[n] == PartMatch::kMoves) continue;
            Group& group = groups[out[n]];
            group.box.add(static_cast<std::int32_t>(n % std::size_t(gap_.width)),
                          static_cast<std::int32_t>(n / std::size_t(gap_.width)));
            ++(group.*samples);
        }
    };
    assign(low, match.low, low_, &Group::low);
    assign(high, match.high, high_, &Group::high);
    for (std::uint32_t n = 0; n < groups.size(); ++n) groups[n].number = n;
    return groups;
}

/// Calls value(section between, sample, x and y in the box) for all samples of a box, and keeps the largest.
template <class Value>
void GapFiller::put_values(const SectionBox& box, std::uint32_t label, Value&& value) {
    const auto put_section = [&](std::uint32_t n) {
        std::vector<float>& best = best_[n];
        std::vector<std::uint32_t>& layer = layer_[n + 1];
        const float t = static_cast<float>(n + 1) / static_cast<float>(gap_.steps);
        std::size_t sample = 0;
        for (std::int32_t y = box.y0; y < box.y1; ++y)
            for (std::int32_t x = box.x0; x < box.x1; ++x, ++sample) {
                const float f = value(t, sample, x - box.x0, y - box.y0);
                const std::size_t at = std::size_t(y) * std::size_t(gap_.width) + std::size_t(x);
                if (f <= best[at]) continue;
                best[at] = f;
                layer[at] = label;
            }
    };
    const std::uint32_t threads = box.samples() < kFewestInParallel ? 1 : threads_;
    parallel_for(gap_.between(), threads, put_section);
}

void GapFiller::put(const Group& group) {
    if (group.low == 0 && group.high == 0) return;
    const auto margin = [&](float step) { return static_cast<std::int32_t>(std::ceil(cap_ / step)) + 1; };
    a_.box = b_.box = group.box.grown(margin(gap_.step.x), margin(gap_.step.y), gap_.width, gap_.height);
    if (group.low == 0 || group.high == 0)
        put_end(group);
    else
        put_pair(group);
}

namespace {

/// One byte a sample of the box: whether it is of the group.
void mark(const std::vector<std::uint32_t>& group, std::uint32_t own, const SectionBox& box, std::int32_t width,
          std::vector<std::uint8_t>& inside) {
    inside.resize(box.samples());
    std::size_t n = 0;
    for (std::int32_t y = box.y0; y < box.y1; ++y)
        for (std::int32_t x = box.x0; x < box.x1; ++x)
            inside[n++] = group[std::size_t(y) * std::size_t(width) + std::size_t(x)] == own;
}

}  // namespace

/// A cone over the part, which ends halfway.
void GapFiller::put_end(const Group& group) {
    const bool is_low = group.low > 0;
    mark(is_low ? low_ : high_, group.number, a_.box, gap_.width, inside_);
    signed_distances(inside_, gap_.step, cap_, a_);
    smooth(a_, kPasses);
    const float depth = std::ranges::max(a_.values);
    put_values(a_.box, group.label, [&](float t, std::size_t sample, std::int32_t, std::int32_t) {
        return a_.values[sample] - 2 * (is_low ? t : 1 - t) * depth;
    });
}

void GapFiller::put_pair(const Group& group) {
    mark(high_, group.number, b_.box, gap_.width, inside_);
    const std::vector<std::uint8_t> high = inside_;
    mark(low_, group.number, a_.box, gap_.width, inside_);
    signed_distances(inside_, gap_.step, cap_, a_);
    smooth(a_, kPasses);
    signed_distances(high, gap_.step, cap_, b_);
    smooth(b_, kPasses);
    Motion motion;
    if (group.parts == 2) {
        motion = centroid(high, b_.box) - centroid(inside_, a_.box);
        const auto share = [&](Motion by) {
            const auto shared = static_cast<float>(moved_overlap(inside_, high, a_.box, by));
            return shared / (static_cast<float>(group.low + group.high) - shared);
        };
        const float length = std::hypot(motion.x * gap_.step.x, motion.y * gap_.step.y);
        if (share(motion) < share({}) + kGain * length) motion = {};
    }
    if (motion.is_none())
        put_values(a_.box, group.label, [&](float t, std::size_t sample, std::int32_t, std::int32_t) {
            return (1 - t) * a_.values[sample] + t * b_.values[sample];
        });
    else
        put_values(a_.box, group.label, [&](float t, std::size_t, std::int32_t x, std::int32_t y) {
            return moved_field(a_, b_, motion, t, static_cast<float>(x), static_cast<float>(y));
        });
}

/// A part that moves farther from section to section than it is wide is drawn out along its way.
void GapFiller::move(const SectionParts& low, const SectionParts& high, std::uint32_t a, std::uint32_t b) {
    SectionBox box = low.parts[a].box;
    box.add(high.parts[b].box);
    const auto margin = [&](float step) { return static_cast<std::int32_t>(std::ceil(cap_ / step)) + 1; };
    a_.box = b_.box = box.grown(margin(gap_.step.x), margin(gap_.step.y), gap_.width, gap_.height);
    mark(high.number, b, b_.box, gap_.width, inside_);
    const std::vector<std::uint8_t> to = inside_;
    mark(low.number, a, a_.box, gap_.width, inside_);
    signed_distances(inside_, gap_.step, cap_, a_);
    smooth(a_, kPasses);
    signed_distances(to, gap_.step, cap_, b_);
    smooth(b_, kPasses);
    Motion motion = centroid(to, b_.box) - centroid(inside_, a_.box);
    if (moved_overlap(inside_, to, a_.box, motion) * 2 < std::min(size_of(inside_), size_of(to)))
        motion = deepest(b_) - deepest(a_);
    const float depth = std::min(std::ranges::max(a_.values), std::ranges::max(b_.values));
    const float each = std::hypot(motion.x * gap_.step.x, motion.y * gap_.step.y) / static_cast<float>(gap_.steps);
    const auto pieces = static_cast<std::uint32_t>(std::ceil(each / std::max(depth, 1.0F)));
    put_values(a_.box, index_of(low.parts[a].label), [&](float t, std::size_t, std::int32_t i, std::int32_t j) {
        const auto x = static_cast<float>(i), y = static_cast<float>(j);
        float best = moved_field(a_, b_, motion, t, x, y);
        for (std::uint32_t n = 0; pieces > 1 && n <= pieces; ++n) {
            const float along = static_cast<float>(n) / static_cast<float>(pieces) - 0.5F;
            const float s = std::clamp(t + along / static_cast<float>(gap_.steps), 0.0F, 1.0F);
            best = std::max(best, moved_field(a_, b_, motion, s, x, y));
        }
        return best > 0 ? best + kMoving : -std::numeric_limits<float>::infinity();
    });
}

void GapFiller::fill(const Gap& gap, std::span<const InputLabel> low, std::span<const InputLabel> high) {
    gap_ = gap;
    cap_ = std::max(kLeastCap, gap.distance);
    const SectionParts low_parts = find_parts(low, gap.width), high_parts = find_parts(high, gap.width);
    find_labels(low_parts, high_parts);
    const PartMatch match = match_parts(low_parts, high_parts, match_options(gap));
    best_.resize(gap.between());
    for (std::uint32_t n = 0; n < gap.between(); ++n) {
        best_[n].assign(gap.samples(), -std::numeric_limits<float>::infinity());
        layer_[n + 1] = 2 * (n + 1) <= gap.steps ? layer_.front() : layer_.back();  // where no field reaches
    }
    for (const Group& group : groups_of(low_parts, high_parts, match)) put(group);
    for (const auto& [a, b] : match.moves) move(low_parts, high_parts, a, b);
    give_away_loose_parts(layer_, gap.width);
}

void GapFiller::copy(std::uint32_t n, std::span<InputLabel> section) const {
    const std::vector<std::uint32_t>& layer = layer_[n + 1];
    for (std::size_t sample = 0; sample < section.size(); ++sample) section[sample] = labels_[layer[sample]];
}

}  // namespace regionmesh
