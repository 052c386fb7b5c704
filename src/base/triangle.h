// Measures of a triangle.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/lanes.h"
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

/// QualityTerms::product of one triangle or of several, one per lane, from area and squared edge lengths.
template <class T>
T quality_product(T area, T l0, T l1, T l2) {
    const T a = square_root(l0), b = square_root(l1), c = square_root(l2);
    const T shortest = least(a, least(b, c));
    // a * b * c / l_min is l_max * l_med; the inscribed radius is area over half the perimeter.
    const T others = greatest(a, greatest(b, c)) * greatest(least(a, b), least(greatest(a, b), c));
    const T perimeter = a + b + c;
    return others * (shortest + (perimeter > 0 ? 8 * area / perimeter : T{}));
}

/// Terms of a triangle from its area and squared edge lengths.
inline QualityTerms quality_terms(double area, double l0, double l1, double l2) {
    return {area, quality_product(area, l0, l1, l2)};
}

inline QualityTerms quality_terms(Vec3 a, Vec3 b, Vec3 c) {
    return quality_terms(0.5 * length(area_vector(a, b, c)), length2(b - a), length2(c - b), length2(a - c));
}

/// True only if the quality is above the bound, as of most faces; without roots. With r < l_min / 2 the product is less
/// than 3 l_max l_med l_min.
inline bool quality_is_surely_above(double bound, Vec3 a, Vec3 b, Vec3 c) {
    const double area2 = 0.25 * length2(area_vector(a, b, c)), most = 9.01 * bound * bound * bound;
    const double lengths2 = length2(b - a) * length2(c - b) * length2(a - c);
    return area2 * area2 * area2 > most * most * (lengths2 * lengths2);
}

/// Shewchuk's scale-invariant quality Q = area / (l_max l_med (l_min + 4 r))^(2/3). P eq. 3 prints l_min for l_max, but
/// the three values it gives need l_max. Equilateral 0.26, right isosceles 0.24, degenerate 0.
inline double face_quality(Vec3 a, Vec3 b, Vec3 c) { return quality_terms(a, b, c).value(); }

}  // namespace regionmesh
