#include "check/quality_sum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/triangle.h"

namespace regionmesh {
namespace {

/// cosine / (|cosine| + sine), which falls from 1 to -1 as the angle grows from 0 to 180 degrees.
double place_of(double sine, double cosine) { return cosine / (std::abs(cosine) + sine); }

/// Finds the bin of ten degrees without an arc tangent. The cuts are so fine that no two bins begin in the same cut.
class AngleBins {
public:
    AngleBins() {
        first_.fill(0);
        next_.fill(-2);
        for (int bin = 1; bin < 18; ++bin) {
            const double angle = bin * 10 * std::numbers::pi / 180;
            const double place = place_of(std::sin(angle), std::cos(angle));
            const int cut = cut_of(place);
            next_[cut] = place;
            for (int later = cut + 1; later < kCuts; ++later) first_[later] = bin;
        }
    }
    /// -1 within the rounding error.
    int bin(double place) const {
        const int cut = cut_of(place);
        const double beyond = next_[cut] - place;
        if (std::abs(beyond) < 1e-12) return -1;
        return first_[cut] + (beyond > 0);
    }

private:
    static constexpr int kCuts = 65;
    static int cut_of(double place) { return std::clamp(int((1 - place) * (kCuts / 2) + 0.5), 0, kCuts - 1); }

    std::array<int, kCuts> first_;    // the bin of the smallest angles in a cut
    std::array<double, kCuts> next_;  // where the next bin begins in a cut
};

const AngleBins kAngleBins;

}  // namespace

void QualitySum::add(const std::array<Vec3, 3>& p) {
    const Vec3 u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
    const double uu = dot(u, u), vv = dot(v, v), ww = dot(w, w), twice_area = length(area_vector(p[0], p[1], p[2]));
    const bool is_finite = std::isfinite(uu + vv + ww + twice_area);
    const double q = is_finite ? quality_terms(0.5 * twice_area, uu, vv, ww).value() : 0;
    ++faces_;
    min_ = std::min(min_, q);
    sum_ += q;
    ++histogram_[std::clamp(int(q * 100), 0, int(histogram_.size()) - 1)];
    if (!is_finite) return;
    const bool is_thin = twice_area < 1e-3 * std::max({uu, vv, ww});  // then each corner needs its own sine
    const auto sine = [&](Vec3 s, Vec3 t) { return is_thin ? length(cross(s, t)) : twice_area; };
    add_angle(sine(u, -w), dot(u, -w));
    add_angle(sine(v, -u), dot(v, -u));
    add_angle(sine(w, -v), dot(w, -v));
}

void QualitySum::add_angle(double sine, double cosine) {
    const Angle angle{sine, cosine, sine > 0 ? place_of(sine, cosine) : cosine < 0 ? -1.0 : 1.0};
    if (angle.place > smallest_.place) smallest_ = angle;
    if (angle.place < largest_.place) largest_ = angle;
    int bin = cosine == 0 && sine > 0 ? 9 : kAngleBins.bin(angle.place);
    if (bin < 0) bin = std::clamp(int(degrees(angle) / 10), 0, 17);
    ++angle_histogram_[bin];
}

double QualitySum::degrees(const Angle& angle) { return std::atan2(angle.sine, angle.cosine) * 180 / std::numbers::pi; }

void QualitySum::append(const QualitySum& later) {
    faces_ += later.faces_;
    sum_ += later.sum_;
    min_ = std::min(min_, later.min_);
    if (later.smallest_.place > smallest_.place) smallest_ = later.smallest_;
    if (later.largest_.place < largest_.place) largest_ = later.largest_;
    for (std::size_t n = 0; n < histogram_.size(); ++n) histogram_[n] += later.histogram_[n];
    for (std::size_t n = 0; n < angle_histogram_.size(); ++n) angle_histogram_[n] += later.angle_histogram_[n];
}

QualityReport QualitySum::report() const {
    QualityReport report;
    if (faces_ == 0) return report;
    report.min = min_;
    report.mean = sum_ / static_cast<double>(faces_);
    report.histogram = histogram_;
    report.min_angle = degrees(smallest_);
    report.max_angle = degrees(largest_);
    report.angle_histogram = angle_histogram_;
    return report;
}

}  // namespace regionmesh
