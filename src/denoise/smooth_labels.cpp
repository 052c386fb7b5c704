#include "denoise/smooth_labels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace regionmesh {
namespace {

/// Distance at which weights round a sample end, in standard deviations.
constexpr double kCutOff = 2;

/// Calls visit(step, length) for all steps no longer than `radius`.
template <class Visit>
void for_steps(Vec3 spacing, double radius, Visit&& visit) {
    const auto reach = [&](double size) { return static_cast<std::int32_t>(std::floor(radius / size)); };
    for (std::int32_t k = -reach(spacing.z); k <= reach(spacing.z); ++k)
        for (std::int32_t j = -reach(spacing.y); j <= reach(spacing.y); ++j)
            for (std::int32_t i = -reach(spacing.x); i <= reach(spacing.x); ++i) {
                const double far = length({i * spacing.x, j * spacing.y, k * spacing.z});
                if (far <= radius) visit(LabelStep{i, j, k, 0}, far);
            }
}

}  // namespace

BoundaryDistance::BoundaryDistance(Vec3 spacing, double distance) {
    // Half a step of one sample is the least that any boundary is away, also along the widest spacing.
    const double most = std::max(distance, 0.0) * 2 + std::max({spacing.x, spacing.y, spacing.z});
    for_steps(spacing, most, [&](LabelStep step, double far) {
        const int samples = std::max({std::abs(step.i), std::abs(step.j), std::abs(step.k)});
        if (samples == 0) return;
        const double boundary = far * (1 - 0.5 / samples);
        if (boundary > distance) return;
        step.value = static_cast<float>(boundary);
        steps_.push_back(step);
        is_short_ = is_short_ && samples == 1;
        reach_ = std::max(reach_, static_cast<std::uint32_t>(std::abs(step.k)));
    });
    std::ranges::stable_sort(steps_, {}, &LabelStep::value);
}

float BoundaryDistance::of(const LabelWindow& window, std::int64_t i, std::int64_t j, std::int64_t s) const {
    const Label own = *window.at(i, j, s);
    for (const LabelStep& step : steps_)
        if (const Label* label = window.at(i + step.i, j + step.j, s + step.k); label && *label != own)
            return step.value;
    return -1;
}

SmoothLabels::SmoothLabels(Vec3 spacing, double deviation, const LabelTable& labels) : labels_(labels) {
    for_steps(spacing, kCutOff * deviation, [&](LabelStep step, double far) {
        step.value = static_cast<float>(std::exp(-far * far / (2 * deviation * deviation)));
        kernel_.push_back(step);
    });
    // The sample itself first; the order decides how weights are summed.
    std::ranges::stable_sort(kernel_, std::greater(), &LabelStep::value);
}

std::uint32_t SmoothLabels::reach_of(Vec3 spacing, double deviation) {
    return static_cast<std::uint32_t>(std::floor(kCutOff * deviation / spacing.z));
}

Label SmoothLabels::of(const LabelWindow& window, std::int64_t i, std::int64_t j, std::int64_t s,
                       Weights& weights) const {
    weights.clear();
    for (const LabelStep& step : kernel_) {
        const Label* label = window.at(i + step.i, j + step.j, s + step.k);
        if (!label) continue;
        const auto known = std::ranges::find(weights, *label, &Weights::value_type::first);
        if (known == weights.end())
            weights.emplace_back(*label, step.value);
        else
            known->second += step.value;
    }
    const Label own = weights.front().first;
    auto best = weights.front();
    for (const auto& other : weights)
        if (other.second > best.second || (other.second == best.second && best.first != own &&
                                           labels_.less(labels_.input(other.first), labels_.input(best.first))))
            best = other;
    return best.first;
}

}  // namespace regionmesh
