// Lines of samples, and where a triangle crosses them: exact.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "regionmesh/lattice.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The samples of a lattice as lines along x, in rows along y and sections along z: the axes of the lattice may be
/// permuted. Which triangles a line crosses, and on which side of a triangle a sample lies, are signs of determinants
/// of the coordinates as given, and exact. Ties are broken by symbolic perturbation (Edelsbrunner and Muecke 1990):
/// every sample is moved by (e^3, e, e^2) along the axes of the lattice, whatever the lines, for an infinitely small e,
/// toward the inside of a box along each axis: that of the lattice, or of a model (turn_back_at).
class SampleLines {
public:
    using Triangle = std::array<Vec3, 3>;

    /// Axis n of the lines is axis axes[n] of the lattice; its direction is not looked at. Sample n of an axis lies at
    /// origin + n * spacing, rounded as the mesher does.
    SampleLines(const Lattice& lattice, const std::array<int, 3>& axes);

    /// The box ends at this coordinate: samples there and above are moved back, all others forward.
    void turn_back_at(int axis, double coordinate);

    std::uint32_t size(int axis) const { return size_[axis]; }
    double spacing(int axis) const { return spacing_[axis]; }
    double at(int axis, std::uint32_t n) const { return origin_[axis] + n * spacing_[axis]; }
    /// Index along an axis, not rounded.
    double index_of(int axis, double coordinate) const { return (coordinate - origin_[axis]) / spacing_[axis]; }

    struct Crossing {
        bool is_ahead;               // the normal of the triangle points along the line
        std::uint32_t first_beyond;  // first sample of the line beyond the triangle; size(0) for none
    };
    /// None where the line does not cross the triangle.
    std::optional<Crossing> crossing(const Triangle& p, std::uint32_t row, std::uint32_t section) const;

private:
    double inward(int axis, std::uint32_t n) const { return n < turn_[axis] ? 1 : -1; }
    std::uint32_t first_beyond(const Triangle& p, bool ahead, Vec3 line, Vec3 nudge) const;

    std::array<std::uint32_t, 3> size_;
    std::array<std::uint32_t, 3> turn_;  // the first sample that is moved back; size_ for none
    std::array<double, 3> origin_, spacing_;
    std::array<int, 3> by_nudge_;  // axes, that of the longest move first
};

}  // namespace regionmesh
