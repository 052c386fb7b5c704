// Counts steps of boundaries by position, bumps and dents of one sample, and strays, in one pass over the sections.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "denoise/enlargement.h"
#include "denoise/kuhn_link.h"
#include "denoise/tuning.h"
#include "regionmesh/denoise.h"

namespace regionmesh {
namespace {

std::string rounded(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", number);
    return text;
}

/// A bump of one label in another, and how often it occurs.
using Bump = std::pair<InputLabel, InputLabel>;

struct RowCounts {
    std::uint64_t boundary = 0, stray = 0, across_row = 0, across_section = 0, row_upward = 0, section_upward = 0;
    std::vector<Bump> bumps = {};
};

class Counter {
public:
    Counter(const VolumeInfo& info, std::uint32_t width, std::uint32_t height, std::uint32_t count)
        : info_(info), width_(width), height_(height), rows_(height) {
        steps_[0].assign(width, 0);
        steps_[1].assign(height, 0);
        steps_[2].assign(count, 0);
    }

    /// Sections come in order; the one before the last added is counted, since its neighbours are there.
    void add(std::vector<InputLabel> section, std::uint32_t number, std::uint32_t threads) {
        held_.push_back(std::move(section));
        if (held_.size() > 3) held_.pop_front();
        parallel_for(height_, threads, [&](std::uint32_t j) { count_row(j); });
        for (std::uint32_t j = 0; j < height_; ++j) {
            RowCounts& row = rows_[j];
            boundary_ += row.boundary;
            stray_ += row.stray;
            steps_[1][j] += row.across_row;
            steps_[2][number] += row.across_section;
            upward_[1] += row.row_upward;
            upward_[2] += row.section_upward;
            for (const Bump& bump : row.bumps) ++bumps_[bump];
            row = {};
        }
        const auto& last = held_.back();
        for (std::uint32_t j = 0; j < height_; ++j) {
            const InputLabel* row = &last[std::size_t{j} * width_];
            std::uint64_t* steps = steps_[0].data();
            for (std::uint32_t i = 1; i < width_; ++i) steps[i] += row[i] != row[i - 1];
            for (std::uint32_t i = 1; i < width_; ++i) upward_[0] += row[i] > row[i - 1];
        }
    }

    Roughness result() const {
        Roughness roughness;
        std::array<Enlargement, 3> found;
        for (std::size_t axis = 0; axis < 3; ++axis) found[axis] = find_enlargement(steps_[axis]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const Enlargement& other : std::array(found))
                if (found[axis].factor == 1 && other.factor > 1)
                    found[axis] = find_same_enlargement(steps_[axis], other.factor);
        // A plane may have its steps along one axis at the places of a coarser lattice, but they all lead one way.
        const bool is_one = std::ranges::count_if(found, [](const Enlargement& e) { return e.factor > 1; }) == 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (is_one && is_one_way(axis)) found[axis] = {};
            const auto to = static_cast<std::size_t>(info_.sweep.axes[axis]);
            roughness.enlarged[to] = found[axis].factor;
            roughness.first_edge[to] = found[axis].first_edge;
        }
        std::uint64_t both_ways = 0;
        for (const auto& [bump, count] : bumps_)
            if (const auto dent = bumps_.find({bump.second, bump.first}); dent != bumps_.end())
                both_ways += std::min(count, dent->second);
        const double all = std::max<double>(static_cast<double>(boundary_), denoising::kFewestBoundary);
        roughness.ragged = static_cast<double>(both_ways) / all;
        roughness.stray = static_cast<double>(stray_) / all;
        return roughness;
    }

private:
    bool is_one_way(std::size_t axis) const {
        const std::uint64_t all = std::accumulate(steps_[axis].begin(), steps_[axis].end(), std::uint64_t{0});
        const std::uint64_t upward = upward_[axis];
        return 10 * std::min(upward, all - upward) < all;
    }

    void count_row(std::uint32_t j) {
        RowCounts& counts = rows_[j];
        const InputLabel* last = &held_.back()[std::size_t{j} * width_];
        if (j > 0)
            for (std::uint32_t i = 0; i < width_; ++i) {
                counts.across_row += last[i] != (last - width_)[i];
                counts.row_upward += last[i] > (last - width_)[i];
            }
        if (held_.size() > 1) {
            const InputLabel* before = &held_[held_.size() - 2][std::size_t{j} * width_];
            for (std::uint32_t i = 0; i < width_; ++i) {
                counts.across_section += last[i] != before[i];
                counts.section_upward += last[i] > before[i];
            }
        }
        if (held_.size() < 3 || j == 0 || j + 1 == height_) return;
        const InputLabel* rows[9];  // three of each section
        for (int k = 0; k < 3; ++k)
            for (int v = 0; v < 3; ++v)
                rows[3 * k + v] =
                    &held_[static_cast<std::size_t>(k)][(std::size_t{j} + static_cast<std::size_t>(v) - 1) * width_];
        const InputLabel* own = rows[4];
        for (std::uint32_t i = 1; i + 1 < width_; ++i) {
            const InputLabel label = own[i];
            bool is_same = own[i - 1] == label && own[i + 1] == label;
            for (const InputLabel* row : rows) is_same = is_same && row[i] == label;
            if (!is_same) look_at(rows, i, counts);
        }
    }

    /// Counts the sample if there are exactly two labels among it and its 26 neighbours.
    void look_at(const InputLabel* const (&rows)[9], std::uint32_t i, RowCounts& counts) const {
        const InputLabel own = rows[4][i];
        InputLabel other = own;
        int same = -1;  // without the sample itself
        for (const InputLabel* row : rows)
            for (std::uint32_t u = i - 1; u <= i + 1; ++u) {
                const InputLabel label = row[u];
                if (label == own)
                    ++same;
                else if (other == own)
                    other = label;
                else if (label != other)
                    return;
            }
        ++counts.boundary;
        if (same == 0) ++counts.stray;
        if (same == 0 || same > denoising::kMostOfBump) return;
        LinkSet link = 0;
        for (int n = 0; n < kLinkSize; ++n) {
            const LinkStep step = kLinkSteps[static_cast<std::size_t>(n)];
            const InputLabel label = rows[3 * (step.k + 1) + step.j + 1][static_cast<std::int64_t>(i) + step.i];
            if (label == own) link |= static_cast<LinkSet>(1 << n);
        }
        if (is_contractible(link)) counts.bumps.emplace_back(own, other);
    }

    const VolumeInfo& info_;
    std::uint32_t width_, height_;
    std::deque<std::vector<InputLabel>> held_;
    std::vector<RowCounts> rows_;
    std::array<std::vector<std::uint64_t>, 3> steps_;  // by axis of the sweep: boundaries before each position
    std::array<std::uint64_t, 3> upward_{};            // of these to a larger label, by axis of the sweep
    std::uint64_t boundary_ = 0, stray_ = 0;
    std::map<Bump, std::uint64_t> bumps_;
};

}  // namespace

Roughness measure_roughness(SectionReader& reader, std::uint32_t threads) {
    const VolumeInfo& info = reader.info();
    if (info.can_rewind) reader.rewind();
    Counter counter(info, reader.section_width(), reader.section_height(), reader.section_count());
    for (std::uint32_t s = 0; s < reader.section_count(); ++s) {
        std::vector<InputLabel> section(std::size_t{reader.section_width()} * reader.section_height());
        require_section(reader.next(section), info, s);
        counter.add(std::move(section), s, threads);
    }
    return counter.result();
}

bool Roughness::is_enlarged() const { return enlarged != std::array<double, 3>{1, 1, 1}; }

bool Roughness::is_speckled() const { return stray >= denoising::kStray; }

bool Roughness::is_ragged() const {
    return ragged >= denoising::kRagged || (stray >= denoising::kManyStrays && ragged >= denoising::kRaggedIfSpeckled);
}

std::string Roughness::text() const {
    std::string text;
    const auto add = [&](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
    if (is_enlarged()) {
        std::string factors;
        for (const double factor : enlarged) factors += (factors.empty() ? "" : " x ") + rounded(factor);
        add("enlarged " + factors);
    }
    if (is_speckled()) add("speckled (" + rounded(100 * stray) + " % of boundary samples are stray)");
    if (is_ragged() && !is_enlarged())
        add("ragged (" + rounded(100 * ragged) + " % of boundary samples are bumps or dents)");
    return text.empty() ? "clean" : text;
}

}  // namespace regionmesh
