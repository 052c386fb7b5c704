#include "compare/sample.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/parallel_for.h"
#include "base/triangle.h"

namespace regionmesh {
namespace {

constexpr double kLeastSamples = 100;
constexpr std::uint32_t kChunk = 1 << 16;  // of simplices

/// Random numbers in [0, 1), three per sample: one for the place along the stratum, two for that in the simplex.
enum class Coordinate { kAlong, kFirst, kSecond };
double unit(std::uint64_t sample, Coordinate coordinate) {
    return static_cast<double>(mix64(4 * sample + static_cast<std::uint64_t>(coordinate)) >> 11) * 0x1p-53;
}

}  // namespace

Samples::Samples(const SortedStrata& sorted, std::uint64_t count, std::uint32_t threads)
    : sorted_(sorted), ends_(sorted.simplices.size()), starts_{0} {
    parallel_for(static_cast<std::uint32_t>((ends_.size() + kChunk - 1) / kChunk), threads, [&](std::uint32_t chunk) {
        const std::size_t end = std::min(ends_.size(), (std::size_t{chunk} + 1) * kChunk);
        for (std::size_t n = std::size_t{chunk} * kChunk; n < end; ++n) {
            const auto& [a, b, c] = sorted.simplices[n];
            const Vec3 p = sorted.points[a], q = sorted.points[b];
            ends_[n] = is_edge(sorted.simplices[n]) ? length(q - p) : 0.5 * length(area_vector(p, q, sorted.points[c]));
        }
    });
    double total = 0;
    for (const Stratum& stratum : sorted.strata) {
        for (std::uint32_t n = stratum.begin + 1; n < stratum.end; ++n) ends_[n] += ends_[n - 1];
        measures_.push_back(ends_[stratum.end - 1]);
        total += measures_.back();
    }
    const double all = static_cast<double>(count), strata = static_cast<double>(sorted.strata.size());
    const double least = std::clamp(std::floor(all / 10 / strata), 1.0, kLeastSamples);
    for (const double measure : measures_) {
        const double share = measure > 0 ? std::max(least, std::round(all * (measure / total))) : 0;
        starts_.push_back(starts_.back() + static_cast<std::uint64_t>(share));
    }
}

double Samples::along(std::uint64_t sample, std::uint32_t stratum) const {
    return (static_cast<double>(sample - begin(stratum)) + unit(sample, Coordinate::kAlong)) * weight(stratum);
}

Vec3 Samples::point(std::uint64_t sample, const Simplex& s) const {
    const Vec3 a = sorted_.points[s[0]], b = sorted_.points[s[1]];
    const double first = unit(sample, Coordinate::kFirst);
    if (is_edge(s)) return a + first * (b - a);
    // Evenly over a triangle (Turk 1990).
    const double from_a = std::sqrt(first), from_b = unit(sample, Coordinate::kSecond);
    return a + from_a * (b - a + from_b * (sorted_.points[s[2]] - b));
}

std::uint32_t Samples::stratum_of(std::uint64_t sample) const {
    return static_cast<std::uint32_t>(std::ranges::upper_bound(starts_, sample) - starts_.begin()) - 1;
}

std::uint32_t Samples::simplex_at(double along, std::uint32_t stratum, std::uint32_t from) const {
    constexpr std::uint32_t kSteps = 16;  // linear search first: the next sample is rarely farther
    const std::uint32_t last = sorted_.strata[stratum].end - 1;
    std::uint32_t n = from;
    for (const std::uint32_t stop = std::min(last, from + kSteps); n < stop; ++n)
        if (ends_[n] > along) return n;
    const auto at = std::upper_bound(ends_.begin() + n, ends_.begin() + last, along);
    return static_cast<std::uint32_t>(at - ends_.begin());
}

}  // namespace regionmesh
