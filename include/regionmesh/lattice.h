// Where the samples of a volume lie in space, and the order in which its sections are read.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Sample (i, j, k) lies at origin + direction * (i * spacing.x, j * spacing.y, k * spacing.z).
/// Lengths are in the unit of the file. `direction` has columns of unit length, in row-major order: orthogonal up to
/// rounding, unless the file shears the volume, as a tilted scanner does; it may mirror.
struct Lattice {
    std::array<std::uint32_t, 3> size{0, 0, 0};  // samples along x, y, z
    Vec3 spacing{1, 1, 1};
    Vec3 origin{0, 0, 0};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};

    /// The place of a sample by its indices, which need not be whole.
    Vec3 place_of(const std::array<double, 3>& index) const {
        const Vec3 along{index[0] * spacing.x, index[1] * spacing.y, index[2] * spacing.z};
        const auto& d = direction;
        return origin +
               Vec3{dot({d[0], d[1], d[2]}, along), dot({d[3], d[4], d[5]}, along), dot({d[6], d[7], d[8]}, along)};
    }
    /// The box of all samples.
    Box extent() const {
        Box box;
        for (int corner = 0; corner < 8; ++corner)
            box.add(place_of(
                {corner & 1 ? size[0] - 1.0 : 0, corner & 2 ? size[1] - 1.0 : 0, corner & 4 ? size[2] - 1.0 : 0}));
        return box;
    }
    /// The directions in which indices grow, of length 1.
    std::array<Vec3, 3> axes() const {
        const auto& d = direction;
        return {Vec3{d[0], d[3], d[6]}, {d[1], d[4], d[7]}, {d[2], d[5], d[8]}};
    }
    /// Of the cell that the axes span: negative where they mirror.
    double axes_volume() const {
        const auto [x, y, z] = axes();
        return dot(x, cross(y, z));
    }
    /// The same lattice before it is turned: its axes are those of coordinates.
    Lattice along_axes() const {
        Lattice lattice = *this;
        lattice.direction = Lattice().direction;
        return lattice;
    }
    bool is_axis_aligned() const { return direction == std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}; }
};

/// Brings places in space into the axes of a lattice. Inverts `direction`: its transpose is the inverse only where it
/// is a rotation to the last digit.
class IntoAxes {
public:
    explicit IntoAxes(const Lattice& lattice) : origin_(lattice.origin) {
        const auto [x, y, z] = lattice.axes();
        const double volume = lattice.axes_volume();
        rows_ = {cross(y, z) / volume, cross(z, x) / volume, cross(x, y) / volume};
    }
    /// How far a place is from the first sample along each axis, as a length.
    Vec3 operator()(Vec3 place) const {
        const Vec3 from = place - origin_;
        return {dot(rows_[0], from), dot(rows_[1], from), dot(rows_[2], from)};
    }
    /// The sums of what is added up for a place, without signs: rounding loses a share of these.
    Vec3 magnitude(Vec3 place) const {
        const auto sum = [&](Vec3 row) {
            double all = 0;
            for (int n = 0; n < 3; ++n) all += std::abs(row[n]) * (std::abs(place[n]) + std::abs(origin_[n]));
            return all;
        };
        return {sum(rows_[0]), sum(rows_[1]), sum(rows_[2])};
    }

private:
    Vec3 origin_;
    std::array<Vec3, 3> rows_;
};

/// Cells, or samples, from `low` to `high` - 1 along x, y, z.
struct IndexBox {
    std::array<std::uint32_t, 3> low{}, high{};

    std::array<std::uint32_t, 3> size() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }
    friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

/// The lattice of the samples of a box.
inline Lattice cropped(const Lattice& whole, const IndexBox& box) {
    Lattice part = whole;
    part.size = box.size();
    part.origin = whole.place_of({double(box.low[0]), double(box.low[1]), double(box.low[2])});
    return part;
}

/// A factor of z that follows from the input: for sections the power of two that makes samples as far apart along z as
/// along x and y, for drill holes that which makes points along a hole as far apart as holes are.
inline constexpr double kAutoScale = 0;

/// Which way the axes of the patient's space point: RAS, to the right, the front and the head; LPS, to the left, the
/// back and the head. A half turn about z leads from one to the other.
enum class Space { kUnknown, kRas, kLps };

/// "RAS" or "LPS"; empty for kUnknown.
constexpr const char* space_name(Space space) {
    return space == Space::kRas ? "RAS" : space == Space::kLps ? "LPS" : "";
}

/// The space of that name; kUnknown for any other text.
constexpr Space space_named(std::string_view name) {
    return name == "RAS" ? Space::kRas : name == "LPS" ? Space::kLps : Space::kUnknown;
}

/// What a file says of its coordinates, or what is known of those of a model.
struct Coordinates {
    Space space = Space::kUnknown;
    std::optional<double> metres = {};  // metres in a unit of length
    std::optional<Vec3> spacing = {};   // spacing of the samples of a model, along the axes of their lattice
    friend bool operator==(const Coordinates&, const Coordinates&) = default;
};

/// The order in which a volume is read: section s lies at index s of axis `axes[2]`; inside it, `axes[0]` runs fastest.
/// The three orders are cyclic, so that none of them mirrors.
struct Sweep {
    std::array<int, 3> axes{0, 1, 2};
    friend bool operator==(const Sweep&, const Sweep&) = default;
};

inline constexpr Sweep kSweepX{{1, 2, 0}};
inline constexpr Sweep kSweepY{{2, 0, 1}};
inline constexpr Sweep kSweepZ{{0, 1, 2}};

/// How a cell of eight samples is meshed. Both make the same regions, interfaces, lines and quadruple points.
enum class CellKind {
    kAuto,        // kCompact where smoothing keeps every sample and volumes need not be kept; else kTetrahedra
    kCompact,     // whole, from a table: a third of the faces (docs/explanation/compact-cells.md)
    kTetrahedra,  // in six tetrahedra, as the paper does (P 3.2)
};

/// The axis along which a volume is read. kAuto: the axis with the smallest section (P 3.1), z before y before x.
enum class SweepChoice { kAuto, kX, kY, kZ };

}  // namespace regionmesh
