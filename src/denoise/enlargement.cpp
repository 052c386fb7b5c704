#include "denoise/enlargement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "denoise/tuning.h"

namespace regionmesh {
namespace {

/// Positions with changes, few of them left out: those with hardly any beside others with many.
std::vector<double> positions_of(std::span<const std::uint64_t> steps) {
    constexpr std::int64_t kNear = 9;
    std::vector<double> positions;
    const auto count = static_cast<std::int64_t>(steps.size());
    for (std::int64_t i = 1; i < count; ++i) {
        std::uint64_t most = 0;
        for (std::int64_t n = std::max<std::int64_t>(1, i - kNear); n <= std::min(count - 1, i + kNear); ++n)
            most = std::max(most, steps[static_cast<std::size_t>(n)]);
        if (static_cast<double>(steps[static_cast<std::size_t>(i)]) >
            denoising::kEmptyPosition * static_cast<double>(most))
            positions.push_back(static_cast<double>(i));
    }
    return positions;
}

/// The shortest arc of a circle of length `factor` that holds nearly all positions.
struct Arc {
    double length, low;
};

Arc shortest_arc(const std::vector<double>& positions, double factor, std::vector<double>& rest) {
    rest.clear();
    for (const double x : positions) rest.push_back(std::fmod(x, factor));
    std::ranges::sort(rest);
    const std::size_t n = rest.size();
    const auto within = static_cast<std::size_t>(std::ceil(denoising::kShareOnEdges * static_cast<double>(n)));
    Arc best{factor, 0};
    for (std::size_t first = 0; first < n; ++first) {
        const std::size_t last = first + within - 1;
        const double end = last < n ? rest[last] : rest[last - n] + factor;
        if (end - rest[first] < best.length) best = {end - rest[first], rest[first]};
    }
    return best;
}

struct Fit {
    double factor;
    Arc arc;
};

/// The factor nearby that fits best: positions near the end of a long axis drift from one step of factors to the next.
Fit fit_near(const std::vector<double>& positions, double factor, double step, std::vector<double>& rest) {
    constexpr int kParts = 16;
    constexpr double kNearlyFits = 1.3, kRounding = 1e-9;
    Fit best{factor, shortest_arc(positions, factor, rest)};
    if (best.arc.length > kNearlyFits) return best;
    for (int part = -kParts / 2; part <= kParts / 2; ++part) {
        const double other = factor + part * step / kParts;
        const Arc arc = shortest_arc(positions, other, rest);
        if (arc.length < best.arc.length - kRounding) best = {other, arc};
    }
    return best;
}

/// For all positions of the arc the edge lies between the sample before and the position. Among such edges one that
/// both lattices begin at is likely: half a sample before the first. Else the middle.
double edge_of(const Arc& arc, double factor) {
    constexpr double kRounding = 1e-6;
    const double least = arc.low + arc.length - 1, most = arc.low;
    const double common = std::ceil((least + 0.5 - kRounding) / factor) * factor - 0.5;
    if (common <= most + kRounding) return std::fmod(common, factor);
    return std::fmod((least + most) / 2, factor);
}

}  // namespace

Enlargement find_enlargement(std::span<const std::uint64_t> steps) {
    const std::vector<double> positions = positions_of(steps);
    if (positions.size() < denoising::kFewestPositions) return {};
    const double range = positions.back() - positions.front();
    // Edges of a factor are at most one position in `factor`.
    if (static_cast<double>(positions.size()) > range / denoising::kLeastFactor + 2) return {};
    double step = 1. / 64;  // a power of two: whole factors and halves are tried exactly
    while (step * range > 0.25) step /= 2;
    constexpr double kRounding = 1e-9;
    std::vector<double> rest;
    Enlargement found;
    double shortest = HUGE_VAL;
    const auto tries = static_cast<std::int64_t>((denoising::kMostFactor - denoising::kLeastFactor) / step) + 1;
    const double most = std::floor(denoising::kMostFactor / step) * step;
    for (std::int64_t n = 0; n < tries; ++n) {
        const double factor = most - static_cast<double>(n) * step;
        if (static_cast<double>(positions.size()) < 0.5 * range / factor) continue;  // too few edges have changes
        const Fit fit = fit_near(positions, factor, step, rest);
        const bool fits = fit.arc.length < 1 - kRounding;
        if (!fits && found.factor > 1) break;  // past the factors that fit
        if (!fits || fit.arc.length > shortest - kRounding) continue;
        shortest = fit.arc.length;
        found = {fit.factor, edge_of(fit.arc, fit.factor)};
    }
    while (found.factor > 1 && found.first_edge >= 0) found.first_edge -= found.factor;
    return found;
}

Enlargement find_same_enlargement(std::span<const std::uint64_t> steps, double factor) {
    constexpr double kRounding = 1e-9;
    const std::vector<double> positions = positions_of(steps);
    if (positions.size() < denoising::kFewestSamePositions) return {};
    if (static_cast<double>(positions.size()) < 0.5 * (positions.back() - positions.front()) / factor) return {};
    std::vector<double> rest;
    const Arc arc = shortest_arc(positions, factor, rest);
    if (arc.length > 1 - kRounding) return {};
    Enlargement found{factor, edge_of(arc, factor)};
    while (found.first_edge >= 0) found.first_edge -= factor;
    return found;
}

}  // namespace regionmesh
