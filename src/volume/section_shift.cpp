#include "volume/section_shift.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace regionmesh {
namespace {

constexpr double kLookedAt = 65536;    // samples
constexpr int kFirstStep = 8;          // of hill climbing, in samples
constexpr std::ptrdiff_t kWindow = 4;  // sections on each side that make the trend

class Agreement {
public:
    Agreement(std::span<const InputLabel> from, std::span<const InputLabel> to, std::int32_t width)
        : from_(from), to_(to), width_(width), height_(static_cast<std::int32_t>(from.size() / std::size_t(width))) {
        stride_ = std::max(1, static_cast<std::int32_t>(std::sqrt(static_cast<double>(from.size()) / kLookedAt)));
    }

    /// Share of the samples that agree after a motion; none of those that leave the section.
    double operator()(const SectionShift& shift) const {
        const double c = std::cos(shift.angle), s = std::sin(shift.angle);
        const double mid_x = (width_ - 1) / 2.0, mid_y = (height_ - 1) / 2.0;
        std::int64_t inside = 0, equal = 0, all = 0;
        for (std::int32_t y = stride_ / 2; y < height_; y += stride_)
            for (std::int32_t x = stride_ / 2; x < width_; x += stride_) {
                ++all;
                const double u = x - mid_x, v = y - mid_y;
                const auto i = static_cast<std::int32_t>(std::floor(mid_x + c * u - s * v + shift.x + 0.5));
                const auto j = static_cast<std::int32_t>(std::floor(mid_y + s * u + c * v + shift.y + 0.5));
                if (i < 0 || j < 0 || i >= width_ || j >= height_) continue;
                ++inside;
                equal += from_[std::size_t(y) * std::size_t(width_) + std::size_t(x)] ==
                         to_[std::size_t(j) * std::size_t(width_) + std::size_t(i)];
            }
        if (inside * 2 < all) return 0;
        return static_cast<double>(equal) / static_cast<double>(inside);
    }

    /// The angle that moves the corners by about one sample.
    double angle_step() const { return 2 / std::hypot(width_, height_); }

private:
    std::span<const InputLabel> from_, to_;
    std::int32_t width_, height_, stride_;
};

/// Where the top of a roof lies whose ridge and eaves are known, in steps from the ridge.
double top_of(double before, double at, double after) {
    const double fall = at - std::min(before, after);
    return fall > 0 ? std::clamp((after - before) / (2 * fall), -0.5, 0.5) : 0;
}

}  // namespace

SectionShift estimate_shift(std::span<const InputLabel> from, std::span<const InputLabel> to, std::int32_t width,
                            AlignKind kind) {
    const Agreement agreement(from, to, width);
    SectionShift best;
    double share = agreement(best);
    const auto try_shift = [&](const SectionShift& shift) {
        const double own = agreement(shift);
        if (own <= share) return false;
        best = shift;
        share = own;
        return true;
    };
    const int turns = kind == AlignKind::kRigid ? 1 : 0;
    for (int step = kFirstStep; step > 0 && share < 1; step /= 2)
        for (bool is_better = true; is_better;) {
            is_better = false;
            const SectionShift middle = best;
            for (int turn = -turns; turn <= turns; ++turn)
                for (int j = -1; j <= 1; ++j)
                    for (int i = -1; i <= 1; ++i)
                        is_better |= try_shift({middle.x + i * step, middle.y + j * step,
                                                middle.angle + turn * step * agreement.angle_step()});
        }
    const SectionShift found = best;
    const auto share_at = [&](double x, double y) { return agreement({found.x + x, found.y + y, found.angle}); };
    best.x += top_of(share_at(-1, 0), share, share_at(1, 0));
    best.y += top_of(share_at(0, -1), share, share_at(0, 1));
    return best;
}

std::vector<SectionShift> without_trend(std::span<const SectionShift> shifts) {
    std::vector<SectionShift> path(shifts.size() + 1);
    for (std::size_t n = 0; n < shifts.size(); ++n)
        path[n + 1] = {path[n].x + shifts[n].x, path[n].y + shifts[n].y, path[n].angle + shifts[n].angle};
    std::vector<SectionShift> left(path.size());
    const auto count = static_cast<std::ptrdiff_t>(path.size());
    for (const auto member : {&SectionShift::x, &SectionShift::y, &SectionShift::angle})
        for (std::ptrdiff_t n = 0; n < count; ++n) {
            const std::ptrdiff_t low =
                std::clamp<std::ptrdiff_t>(n - kWindow, 0, std::max<std::ptrdiff_t>(0, count - 2 * kWindow - 1));
            const std::ptrdiff_t high = std::min(count - 1, low + 2 * kWindow);
            double sum = 0, t_sum = 0, tt_sum = 0, t_value_sum = 0, values = 0;
            for (std::ptrdiff_t k = low; k <= high; ++k) {
                const auto t = static_cast<double>(k - n);
                ++sum, t_sum += t, tt_sum += t * t, values += path[k].*member, t_value_sum += t * path[k].*member;
            }
            const double spread = sum * tt_sum - t_sum * t_sum;
            const double line = spread > 0 ? (tt_sum * values - t_sum * t_value_sum) / spread : path[n].*member;
            left[n].*member = path[n].*member - line;
        }
    return left;
}

}  // namespace regionmesh
