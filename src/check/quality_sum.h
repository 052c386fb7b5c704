// Sums of the quality and the angles of faces.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "regionmesh/check.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

class QualitySum {
public:
    void add(const std::array<Vec3, 3>& p);
    /// Adds the sums of later faces.
    void append(const QualitySum& later);
    QualityReport report() const;

private:
    /// The sine and cosine of an angle, times a common factor, and its place from 1 at 0 degrees to -1 at 180.
    struct Angle {
        double sine = 0, cosine = 0, place = 0;
    };

    void add_angle(double sine, double cosine);
    static double degrees(const Angle& angle);

    std::uint64_t faces_ = 0;
    double sum_ = 0, min_ = HUGE_VAL;
    std::array<std::uint64_t, 28> histogram_{};
    Angle smallest_{0, 0, -2}, largest_{0, 0, 2};
    std::array<std::uint64_t, 18> angle_histogram_{};
};

}  // namespace regionmesh
