#include "denoise/sweep_window.h"

#include <algorithm>
#include <utility>

#include "base/parallel_for.h"

namespace regionmesh {
namespace {

/// Samples on each side in which a detour round a cut must lie.
constexpr int kDetour = 3;
constexpr int kDetourWidth = 2 * kDetour + 1, kDetourNodes = kDetourWidth * kDetourWidth * kDetourWidth;

}  // namespace

SweepWindow::SweepWindow(const SweepOptions& options, std::uint32_t reach, FindCandidates find, HandOut hand_out)
    : options_(options), find_(std::move(find)), hand_out_(std::move(hand_out)) {
    window_.width = options.width;
    window_.height = options.height;
    plan_stages(reach);
}

void SweepWindow::plan_stages(std::uint32_t reach) {
    const auto add = [&](Kind kind, std::uint32_t reads) {
        const std::uint32_t before = stages_.empty() ? reads : stages_.back().reach;
        stages_.push_back({.kind = kind, .reach = reads, .lag = std::max(reads, before)});
    };
    const auto add_sweeps = [&](int sweeps) {
        for (int n = 0; n < sweeps; ++n) {
            add(Kind::kEven, 1);
            add(Kind::kOdd, 1);
        }
    };
    constexpr int kSweepsAfterCut = 3;
    add(Kind::kFind, reach);
    add_sweeps(options_.sweeps);
    if (options_.cuts)
        for (int n = 0; n < 2; ++n) {
            add(Kind::kCut, kDetour);
            add_sweeps(kSweepsAfterCut);
        }
}

std::uint32_t SweepWindow::sections() const {
    std::uint32_t sum = 1 + kDetour;
    for (const Stage& stage : stages_) sum += stage.lag;
    return std::min(sum, options_.count);
}

void SweepWindow::add(std::vector<Label> section) {
    window_.sections.push_back(std::move(section));
    held_.emplace_back();
    ++added_;
    const bool is_last = added_ == options_.count;
    std::uint32_t before = added_;
    for (Stage& stage : stages_) {
        const std::uint32_t end = is_last ? options_.count : before - std::min(before, stage.lag);
        for (; stage.done < end; ++stage.done) run(stage, stage.done);
        before = stage.done;
    }
    // The last stages read sections that went through all stages.
    const std::uint32_t end = is_last ? options_.count : before - std::min<std::uint32_t>(before, kDetour);
    for (; handed_out_ < end; ++handed_out_) {
        hand_out_(handed_out_, window_.sections.front(), held_.front().moving);
        window_.sections.pop_front();
        held_.pop_front();
        ++window_.first;
    }
}

void SweepWindow::run(const Stage& stage, std::uint32_t section) {
    switch (stage.kind) {
        case Kind::kFind: {
            Held& held = held_[section - window_.first];
            find_(window_, section, held.moving);
            sort_classes(held);
            break;
        }
        case Kind::kEven:
            if (section % 2 == 0) sweep(section);
            break;
        case Kind::kOdd:
            if (section % 2 == 1) sweep(section);
            break;
        case Kind::kCut:
            cut(section);
            break;
    }
}

void SweepWindow::sort_classes(Held& held) const {
    for (std::uint32_t n = 0; n < held.moving.size(); ++n) {
        const std::uint32_t i = held.moving[n].sample % options_.width, j = held.moving[n].sample / options_.width;
        held.by_class[(j & 1) * 2 + (i & 1)].push_back(n);
    }
}

void SweepWindow::sweep(std::uint32_t section) {
    constexpr std::uint32_t kChunk = 512;
    Held& held = held_[section - window_.first];
    std::vector<Label>& labels = window_.section(section);
    for (const auto& numbers : held.by_class)
        for_each_index(static_cast<std::uint32_t>(numbers.size()), kChunk, options_.threads, [&](std::uint32_t n) {
            Moving& candidate = held.moving[numbers[n]];
            if (candidate.is_changed) return;
            if (!is_simple(link_of(section, candidate.sample), candidate.from, candidate.to)) return;
            candidate.is_changed = true;
            labels[candidate.sample] = candidate.to;
        });
}

/// One after the other: whether a part stays connected depends on the cuts before.
void SweepWindow::cut(std::uint32_t section) {
    Held& held = held_[section - window_.first];
    for (Moving& candidate : held.moving) {
        if (candidate.is_changed || !may_cut(section, candidate, link_of(section, candidate.sample))) continue;
        candidate.is_changed = candidate.is_cut = true;
        window_.section(section)[candidate.sample] = candidate.to;
    }
}

/// Only between two regions, and only if neither falls apart, is joined with another part of itself, or begins here.
bool SweepWindow::may_cut(std::uint32_t section, const Moving& candidate, const LinkLabels& link) const {
    LinkSet own = 0, next = 0;
    for (int n = 0; n < kLinkSize; ++n) {
        const Label label = link[static_cast<std::size_t>(n)];
        if (label == candidate.from)
            own |= static_cast<LinkSet>(1 << n);
        else if (label == candidate.to)
            next |= static_cast<LinkSet>(1 << n);
        else if (label != kOutside)
            return false;
    }
    return own && next && are_joined(section, candidate.sample, candidate.from, own) &&
           are_joined(section, candidate.sample, candidate.to, next);
}

/// Are these neighbours of a sample, all of one label, connected within the detour without the sample?
bool SweepWindow::are_joined(std::uint32_t section, std::uint32_t sample, Label label, LinkSet nodes) const {
    if (parts_of(nodes).count == 1) return true;
    const std::int64_t i = sample % options_.width, j = sample / options_.width;
    const auto number = [](int a, int b, int c) {
        return ((c + kDetour) * kDetourWidth + b + kDetour) * kDetourWidth + a + kDetour;
    };
    std::array<bool, kDetourNodes> is_seen{};
    std::array<LinkStep, kDetourNodes> queue;
    int count = 0;
    const auto visit = [&](LinkStep at) {
        if (std::max({at.i, at.j, at.k}) > kDetour || std::min({at.i, at.j, at.k}) < -kDetour) return;
        bool& seen = is_seen[static_cast<std::size_t>(number(at.i, at.j, at.k))];
        if (seen) return;
        const Label* found = window_.at(i + at.i, j + at.j, std::int64_t{section} + at.k);
        if (!found || *found != label) return;
        seen = true;
        queue[static_cast<std::size_t>(count++)] = at;
    };
    is_seen[static_cast<std::size_t>(number(0, 0, 0))] = true;  // no way leads through the sample
    int first = 0;
    while (!(nodes >> first & 1)) ++first;
    visit(kLinkSteps[static_cast<std::size_t>(first)]);
    for (int n = 0; n < count; ++n) {
        const LinkStep at = queue[static_cast<std::size_t>(n)];
        for (const LinkStep step : kLinkSteps) visit({at.i + step.i, at.j + step.j, at.k + step.k});
    }
    for (int n = 0; n < kLinkSize; ++n) {
        const LinkStep step = kLinkSteps[static_cast<std::size_t>(n)];
        if (nodes >> n & 1 && !is_seen[static_cast<std::size_t>(number(step.i, step.j, step.k))]) return false;
    }
    return true;
}

LinkLabels SweepWindow::link_of(std::uint32_t section, std::uint32_t sample) const {
    const std::int64_t i = sample % options_.width, j = sample / options_.width;
    LinkLabels link;
    for (std::size_t n = 0; n < kLinkSize; ++n) {
        const LinkStep step = kLinkSteps[n];
        const Label* label = window_.at(i + step.i, j + step.j, std::int64_t{section} + step.k);
        link[n] = label ? *label : kOutside;
    }
    return link;
}

}  // namespace regionmesh
