// Measures of a triangle.
#pragma once

#include <algorithm>
#include <cmath>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Twice the area, along the normal.
inline Vec3 area_vector(Vec3 a, Vec3 b, Vec3 c) { return cross(b - a, c - a); }

/// The terms of Shewchuk's quality: they give its value, and a comparison without roots.
struct QualityTerms {
    double area;
    double product;  // l_max * l_med * (l_min + 4 r), r the radius of the inscribed circle

    /// Is the quality at least `bound`? Compares third powers.
    bool is_at_least(double bound) const { return area * area * area >= bound * bound * bound * product * product; }
    /// 0 where the square of the product is too small for a number, too.
    double cube() const { return product * product > 0 ? area * area * area / (product * product) : 0.0; }
    double value() const { return product * product > 0 ? area / std::cbrt(product * product) : 0.0; }
};

/// Terms of a triangle from its area and squared edge lengths.
inline QualityTerms quality_terms(double area, double l0, double l1, double l2) {
    const double a = std::sqrt(l0), b = std::sqrt(l1), c = std::sqrt(l2);
    const double shortest = std::min(a, std::min(b, c));
    const double perimeter = a + b + c;
    // a * b * c / l_min is l_max * l_med; the inscribed radius is area over half the perimeter.
    const double others = std::max(a, std::max(b, c)) * std::max(std::min(a, b), std::min(std::max(a, b), c));
    return {area, others * (shortest + (perimeter > 0 ? 8 * area / perimeter : 0.0))};
}

inline QualityTerms quality_terms(Vec3 a, Vec3 b, Vec3 c) {
    return quality_terms(0.5 * length(area_vector(a, b, c)), length2(b - a), length2(c - b), length2(a - c));
}

/// Shewchuk's scale-invariant quality Q = area / (l_max l_med (l_min + 4 r))^(2/3). P eq. 3 prints l_min for l_max, but
/// the three values it gives need l_max. Equilateral 0.26, right isosceles 0.24, degenerate 0.
inline double face_quality(Vec3 a, Vec3 b, Vec3 c) { return quality_terms(a, b, c).value(); }

}  // namespace regionmesh
