#include "compare/sample.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>
#include <utility>

#include "base/hash.h"
#include "base/parallel_for.h"

namespace regionmesh {
namespace {

constexpr double kLeastSamples = 100;
constexpr std::uint64_t kChunk = 4096;  // samples per task

/// Random numbers in [0, 1), three per sample: one for the position along the stratum, two for that in the simplex.
enum class Coordinate { kAlong, kFirst, kSecond };
double unit(std::uint64_t sample, Coordinate coordinate) {
    return static_cast<double>(mix64(4 * sample + static_cast<std::uint64_t>(coordinate)) >> 11) * 0x1p-53;
}

Vec3 point_in(const SortedStrata& sorted, const Simplex& s, std::uint64_t sample) {
    const Vec3 a = sorted.points[s[0]], b = sorted.points[s[1]];
    const double first = unit(sample, Coordinate::kFirst);
    if (is_edge(s)) return a + first * (b - a);
    // Evenly over a triangle (Turk 1990).
    const double from_a = std::sqrt(first), from_b = unit(sample, Coordinate::kSecond);
    return a + from_a * (b - a + from_b * (sorted.points[s[2]] - b));
}

/// The simplex of the stratum in which `along` lies, `from` or a later one.
std::uint32_t simplex_at(const SortedStrata& sorted, const Stratum& stratum, double along, std::uint32_t from) {
    constexpr std::uint32_t kSteps = 16;  // linear search first: the next sample is rarely farther
    const std::vector<double>& ends = sorted.ends;
    const std::uint32_t last = stratum.end - 1;
    std::uint32_t n = from;
    for (const std::uint32_t stop = std::min(last, from + kSteps); n < stop; ++n)
        if (ends[n] > along) return n;
    return static_cast<std::uint32_t>(std::upper_bound(ends.begin() + n, ends.begin() + last, along) - ends.begin());
}

}  // namespace

Samples::Samples(std::vector<double> measures, std::uint64_t count) : measures_(std::move(measures)), starts_{0} {
    const double all = static_cast<double>(count), strata = static_cast<double>(measures_.size());
    const double total = std::accumulate(measures_.begin(), measures_.end(), 0.0);
    const double least = std::clamp(std::floor(all / 10 / strata), 1.0, kLeastSamples);
    for (const double measure : measures_) {
        const double share = measure > 0 ? std::max(least, std::round(all * (measure / total))) : 0;
        starts_.push_back(starts_.back() + static_cast<std::uint64_t>(share));
    }
}

double Samples::along(std::uint64_t sample, std::uint32_t stratum) const {
    return (static_cast<double>(sample - begin(stratum)) + unit(sample, Coordinate::kAlong)) * weight(stratum);
}

std::uint32_t Samples::stratum_of(std::uint64_t sample) const {
    return static_cast<std::uint32_t>(std::ranges::upper_bound(starts_, sample) - starts_.begin()) - 1;
}

SamplePoints::SamplePoints(const Samples& samples) : samples_(samples), points_(samples.size()) {
    for (std::uint32_t stratum = 0; stratum < samples.stratum_count(); ++stratum)
        next_.push_back(samples.begin(stratum));
    before_.resize(next_.size());
}

void SamplePoints::add(const SortedStrata& part, std::span<const std::uint32_t> numbers, std::uint32_t threads) {
    std::vector<Range> ranges;
    for (std::uint32_t stratum = 0; stratum < part.strata.size(); ++stratum) {
        const std::uint32_t number = numbers[stratum];
        const double before = before_[number], after = before + part.measure(part.strata[stratum]);
        const auto left = std::views::iota(next_[number], samples_.end(number));
        const auto is_before_end = [&](std::uint64_t sample) { return samples_.along(sample, number) < after; };
        // The last part has all that is left: the position of a sample may be rounded to the end.
        const std::uint64_t end = after < samples_.measure(number) ? *std::ranges::partition_point(left, is_before_end)
                                                                   : samples_.end(number);
        for (std::uint64_t& first = next_[number]; first < end; first = std::min(end, first + kChunk))
            ranges.push_back({number, stratum, first, std::min(end, first + kChunk), before});
        before_[number] = after;
    }
    parallel_for(static_cast<std::uint32_t>(ranges.size()), threads, [&](std::uint32_t n) { place(part, ranges[n]); });
}

void SamplePoints::place(const SortedStrata& part, const Range& range) {
    const Stratum& stratum = part.strata[range.stratum];
    std::uint32_t simplex = stratum.begin;
    for (std::uint64_t sample = range.first; sample < range.end; ++sample) {
        simplex = simplex_at(part, stratum, samples_.along(sample, range.number) - range.before, simplex);
        points_[sample] = point_in(part, part.simplices[simplex], sample);
    }
}

}  // namespace regionmesh
