// Sums of the quality and the angles of faces.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/lanes.h"
#include "regionmesh/check.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Measures of two faces, one per lane.
struct TwoFaces {
    std::array<Lanes3<Double2>, 3> edges;  // edge from each corner to the next
    Lanes3<Double2> normal;                // twice the area vector
    Double2 twice_area;
    Double2 quality_product;           // QualityTerms::product
    Double2 size2;                     // the longest edge, squared
    std::array<Double2, 3> cosines{};  // cosine at each corner, times the lengths of both edges
    std::array<Double2, 3> keys{};     // bins of the angles (see QualitySum::Angle), if twice_area is the sine of each
    // Bit n is set if face n is neither thin nor tiny: twice_area then serves as the sine of each angle.
    unsigned fat = 0;

    explicit TwoFaces(const std::array<Lanes3<Double2>, 3>& corners);
    bool is_fat(int lane) const { return (fat >> lane & 1) != 0; }
};

class QualitySum {
public:
    void add(const TwoFaces& faces, int lane);
    /// Adds the sums of later faces.
    void append(const QualitySum& later);
    QualityReport report() const;

private:
    /// The sine and cosine of an angle, times a common factor, and its key from 1 at 0 degrees to -1 at 180.
    struct Angle {
        double sine = 0, cosine = 0, key = 0;
    };

    void add_angle(const Angle& angle);
    static double degrees(const Angle& angle);

    std::uint64_t faces_ = 0;
    double sum_ = 0, min_ = HUGE_VAL;
    std::array<std::uint64_t, 28> histogram_{};
    Angle smallest_{0, 0, -2}, largest_{0, 0, 2};
    std::array<std::uint64_t, 18> angle_histogram_{};
};

}  // namespace regionmesh
