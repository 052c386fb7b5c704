#include "check/quality_sum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/triangle.h"

namespace regionmesh {
namespace {

/// cosine / (|cosine| + sine), which falls from 1 to -1 as the angle grows from 0 to 180 degrees.
double key_of(double sine, double cosine) { return cosine / (std::abs(cosine) + sine); }

/// Finds the bin of ten degrees without an arc tangent. The cuts are so fine that no two bins begin in the same cut.
class AngleBins {
public:
    AngleBins() {
        first_.fill(0);
        next_.fill(-2);
        for (int bin = 1; bin < 18; ++bin) {
            const double angle = bin * 10 * std::numbers::pi / 180;
            const double key = key_of(std::sin(angle), std::cos(angle));
            const int cut = cut_of(key);
            next_[cut] = key;
            for (int later = cut + 1; later < kCuts; ++later) first_[later] = bin;
        }
    }
    /// -1 within the rounding error.
    int bin(double key) const {
        const int cut = cut_of(key);
        const double beyond = next_[cut] - key;
        if (std::abs(beyond) < 1e-12) return -1;
        return first_[cut] + (beyond > 0);
    }

private:
    static constexpr int kCuts = 65;
    static int cut_of(double key) { return static_cast<int>((1 - key) * (kCuts / 2) + 0.5); }

    std::array<int, kCuts> first_;    // the bin of the smallest angles in a cut
    std::array<double, kCuts> next_;  // start of the next bin in each cut
};

const AngleBins kAngleBins;

}  // namespace

TwoFaces::TwoFaces(const std::array<Lanes3<Double2>, 3>& corners) {
    std::array<Double2, 3> lengths2;
    for (int n = 0; n < 3; ++n) edges[n] = corners[(n + 1) % 3] - corners[n];
    for (int n = 0; n < 3; ++n) lengths2[n] = dot(edges[n], edges[n]);
    normal = cross(edges[0], corners[2] - corners[0]);
    twice_area = square_root(dot(normal, normal));
    quality_product = regionmesh::quality_product(0.5 * twice_area, lengths2[0], lengths2[1], lengths2[2]);
    size2 = greatest(lengths2[0], greatest(lengths2[1], lengths2[2]));
    fat = bits_of((twice_area >= 1e-3 * size2) & (twice_area > 1e-100));
    for (int n = 0; n < 3; ++n) {
        cosines[n] = -dot(edges[n], edges[(n + 2) % 3]);
        keys[n] = cosines[n] / (greatest(cosines[n], -cosines[n]) + twice_area);
    }
}

void QualitySum::add(const TwoFaces& faces, int lane) {
    const double twice_area = faces.twice_area[lane];
    const bool is_finite = std::isfinite(faces.size2[lane]) && std::isfinite(twice_area);
    const double q = is_finite ? QualityTerms{0.5 * twice_area, faces.quality_product[lane]}.value() : 0;
    ++faces_;
    min_ = std::min(min_, q);
    sum_ += q;
    ++histogram_[std::clamp(int(q * 100), 0, int(histogram_.size()) - 1)];
    if (!is_finite) return;
    std::array<Angle, 3> angles;
    for (int n = 0; n < 3; ++n) angles[n] = {twice_area, faces.cosines[n][lane], faces.keys[n][lane]};
    if (!faces.is_fat(lane))  // each corner needs its own sine
        for (int n = 0; n < 3; ++n) {
            auto& [sine, cosine, key] = angles[n];
            sine = length(cross(faces.edges[n][lane], faces.edges[(n + 2) % 3][lane]));
            key = sine > 0 ? key_of(sine, cosine) : cosine < 0 ? -1.0 : 1.0;
        }
    for (const Angle& angle : angles) add_angle(angle);
}

void QualitySum::add_angle(const Angle& angle) {
    if (angle.key > smallest_.key) smallest_ = angle;
    if (angle.key < largest_.key) largest_ = angle;
    int bin = angle.cosine == 0 && angle.sine > 0 ? 9 : kAngleBins.bin(angle.key);
    if (bin < 0) bin = std::clamp(int(degrees(angle) / 10), 0, 17);
    ++angle_histogram_[bin];
}

double QualitySum::degrees(const Angle& angle) { return std::atan2(angle.sine, angle.cosine) * 180 / std::numbers::pi; }

void QualitySum::append(const QualitySum& later) {
    faces_ += later.faces_;
    sum_ += later.sum_;
    min_ = std::min(min_, later.min_);
    if (later.smallest_.key > smallest_.key) smallest_ = later.smallest_;
    if (later.largest_.key < largest_.key) largest_ = later.largest_;
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
