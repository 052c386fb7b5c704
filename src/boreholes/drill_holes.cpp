#include "boreholes/drill_holes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "boreholes/arc.h"
#include "formats/input_file.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"
#include "regionmesh/limits.h"

namespace regionmesh::formats {
namespace {

constexpr double kMostOverlap = 0.05;  // share of the longer interval

/// Overlapping intervals of one label, merged.
struct Run {
    double top, bottom;
    const Interval* deepest;  // reaches to the bottom
};

std::string hole_of(const DrillHoles& holes, const Interval& interval) {
    return holes.holes.size() == 0 ? "" : fmt::format(" of hole '{}'", shown(holes.holes.text(interval.hole)));
}

/// Sweeps downwards at each x, y. Few runs are open at a time, since runs of similar length hardly overlap.
class OverlapSweep {
public:
    OverlapSweep(const DrillHoles& holes, const TableLabels& labels) : holes_(holes), labels_(labels) {}

    void add(const Interval& interval) {
        if (!open_.empty() && (open_[0].deepest->x != interval.x || open_[0].deepest->y != interval.y)) open_.clear();
        std::erase_if(open_, [&](const Run& run) { return run.bottom >= interval.top; });
        Run* same = nullptr;
        for (Run& run : open_) {
            if (run.deepest->label == interval.label) {
                same = &run;
                continue;
            }
            const double overlap = interval.top - std::max(run.bottom, interval.bottom);
            const double longer = std::max(run.top - run.bottom, interval.top - interval.bottom);
            if (overlap > kMostOverlap * longer) refuse(*run.deepest, interval, overlap);
        }
        if (same) {
            if (interval.bottom < same->bottom)
                std::tie(same->bottom, same->deepest) = std::pair(interval.bottom, &interval);
        } else {
            open_.push_back({interval.top, interval.bottom, &interval});
        }
    }

private:
    [[noreturn]] void refuse(const Interval& a, const Interval& b, double overlap) const {
        const auto& [first, second] = std::minmax(a, b, [](const auto& i, const auto& j) { return i.row < j.row; });
        const std::string hole = hole_of(holes_, first), other = hole_of(holes_, second);
        fail(holes_.path, fmt::format("rows {}{} and {}{}: '{}' and '{}' overlap by {:.6g}; a place has one label, "
                                      "mend one of them",
                                      first.row, hole == other ? "" : hole, second.row, other,
                                      shown(labels_.text(first.label)), shown(labels_.text(second.label)), overlap));
    }

    const DrillHoles& holes_;
    const TableLabels& labels_;
    std::vector<Run> open_;
};

/// The place at a share of the length of an interval.
Vec3 place_in(const Interval& interval, double share) {
    const Vec3 top{interval.x, interval.y, interval.top};
    if (angle_between(interval.upper, interval.lower) >= kStraight)
        return top + along_arc(interval.upper, between(interval.upper, interval.lower, share), interval.length * share);
    return {interval.x + (interval.bottom_x - interval.x) * share,
            interval.y + (interval.bottom_y - interval.y) * share,
            interval.top + (interval.bottom - interval.top) * share};
}

/// The number of parts of an interval.
double part_count(const Interval& interval, std::optional<double> step) {
    return step ? std::max(1.0, std::ceil(interval.length / *step)) : 1;
}

}  // namespace

void refuse_overlaps(const DrillHoles& holes, const TableLabels& labels) {
    const std::vector<Interval>& intervals = holes.intervals;
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < intervals.size(); ++i)
        if (intervals[i].label != kNoLabel) order.push_back(i);
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

void find_collars(DrillHoles& holes) {
    std::map<std::pair<double, double>, double> tops;
    for (const Interval& interval : holes.intervals) {
        double& top = tops.try_emplace({interval.x, interval.y}, interval.collar).first->second;
        top = std::max(top, interval.collar);
    }
    for (const auto& [place, top] : tops) holes.collars.push_back({place.first, place.second, top});
    for (Interval& interval : holes.intervals)
        interval.is_at_collar = interval.top >= tops.at({interval.x, interval.y});
}

double mean_distance(const std::vector<HeightSample>& places) {
    double sum = 0, count = 0;
    for (std::size_t a = 0; a < places.size(); ++a) {
        double least = INFINITY;
        for (std::size_t b = 0; b < places.size(); ++b) {
            const double distance = std::hypot(places[a].x - places[b].x, places[a].y - places[b].y);
            if (a != b && distance > 0) least = std::min(least, distance);
        }
        if (std::isfinite(least)) sum += least, ++count;
    }
    return count > 0 ? sum / count : 0;
}

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
            table.points.positions.push_back(place_in(interval, part / parts));
            table.points.labels.push_back(interval.label);
            table.rows.push_back(interval.row);
        }
    }
}

}  // namespace regionmesh::formats
