#include "boreholes/drill_holes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "formats/input_file.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr double kMostOverlap = 0.05;  // of the longer interval

/// Overlapping intervals of one label, merged.
struct Run {
    double top, bottom;
    const Interval* first;
};

std::string hole_of(const DrillHoles& holes, const Interval& interval) {
    return holes.holes.size() == 0 ? "" : fmt::format(" of hole '{}'", shown(holes.holes.text(interval.hole)));
}

/// Sweeps downwards at each x, y. Few runs are open at a time, since runs of similar length hardly overlap.
class OverlapSweep {
public:
    OverlapSweep(const DrillHoles& holes, const TableLabels& labels) : holes_(holes), labels_(labels) {}

    void add(const Interval& interval) {
        if (!open_.empty() && (open_[0].first->x != interval.x || open_[0].first->y != interval.y)) open_.clear();
        std::erase_if(open_, [&](const Run& run) { return run.bottom >= interval.top; });
        Run* same = nullptr;
        for (Run& run : open_) {
            if (run.first->label == interval.label) {
                same = &run;
                continue;
            }
            const double overlap = interval.top - std::max(run.bottom, interval.bottom);
            const double longer = std::max(run.top - run.bottom, interval.top - interval.bottom);
            if (overlap > kMostOverlap * longer) refuse(*run.first, interval, overlap);
        }
        if (same) {
            same->bottom = std::min(same->bottom, interval.bottom);
        } else {
            open_.push_back({interval.top, interval.bottom, &interval});
        }
    }

private:
    [[noreturn]] void refuse(const Interval& a, const Interval& b, double overlap) const {
        const auto& [first, second] = std::minmax(a, b, [](const auto& i, const auto& j) { return i.row < j.row; });
        fail(holes_.path, fmt::format("rows {} and {}{}: '{}' and '{}' overlap by {:.6g}; a place has one label, "
                                      "mend one of them",
                                      first.row, second.row, hole_of(holes_, b), shown(labels_.text(first.label)),
                                      shown(labels_.text(second.label)), overlap));
    }

    const DrillHoles& holes_;
    const TableLabels& labels_;
    std::vector<Run> open_;
};

/// The number of parts of an interval.
double part_count(const Interval& interval, std::optional<double> step) {
    return step ? std::max(1.0, std::ceil(interval.length / *step)) : 1;
}

}  // namespace

void refuse_overlaps(const DrillHoles& holes, const TableLabels& labels) {
    const std::vector<Interval>& intervals = holes.intervals;
    std::vector<std::uint32_t> order(intervals.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const Interval& interval = intervals[i];
        return std::tuple(interval.x, interval.y, -interval.top, i);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    OverlapSweep sweep(holes, labels);
    for (const std::uint32_t i : order) sweep.add(intervals[i]);
}

namespace {

/// Position, label and row.
constexpr double kBytesPerPoint = 36;

double physical_bytes() {
    return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void append_points(const DrillHoles& holes, std::optional<double> step, PointTable& table) {
    double total = 0;
    for (const Interval& interval : holes.intervals) {
        total += part_count(interval, step);
        if (!(total <= static_cast<double>(kMostPoints)))
            fail(holes.path, fmt::format("row {}: with --step {} there are more than {} points; give a larger one",
                                         interval.row, step.value_or(0), kMostPoints));
    }
    const std::size_t count = table.rows.size() + static_cast<std::size_t>(total);
    if (total * kBytesPerPoint > physical_bytes())
        fail(holes.path, fmt::format("with --step {} there are {} points, more than memory holds; give a larger one",
                                     step.value_or(0), count));
    table.points.positions.reserve(count);
    table.points.labels.reserve(count);
    table.rows.reserve(count);
    for (const Interval& interval : holes.intervals) {
        const double parts = part_count(interval, step);
        for (double part = 0.5; part < parts; ++part) {
            const double z = interval.top + (interval.bottom - interval.top) * (part / parts);
            table.points.positions.push_back({interval.x, interval.y, z});
            table.points.labels.push_back(interval.label);
            table.rows.push_back(interval.row);
        }
    }
}

}  // namespace regionmesh::formats
