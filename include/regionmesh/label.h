// Labels: 64 bits in the input, dense 32-bit numbers inside the library.
#pragma once

#include <cstdint>

namespace regionmesh {

/// A label of the input, bit for bit. Unsigned 64-bit labels keep their bits (see LabelTable).
using InputLabel = std::int64_t;

/// Their numeric order.
struct InputLabelOrder {
    bool is_unsigned = false;

    bool operator()(InputLabel a, InputLabel b) const {
        return is_unsigned ? static_cast<std::uint64_t>(a) < static_cast<std::uint64_t>(b) : a < b;
    }
};

/// A dense label: regions are numbered from 0 in order of first appearance; the exteriors have the highest numbers.
using Label = std::uint32_t;

inline constexpr Label kFirstExterior = 0xFFFFFFF0u;

/// The exterior beyond one side of the box. Sides 0..5 are x low, x high, y low, y high, z low, z high. Tetrahedra that
/// do not fill a box have one exterior, beyond side kHull.
inline constexpr int kHull = 6, kSideCount = 7;
constexpr Label exterior(int side) { return kFirstExterior + static_cast<Label>(side); }
constexpr bool is_exterior(Label label) { return label >= kFirstExterior; }
constexpr int side_of(Label label) { return static_cast<int>(label - kFirstExterior); }

/// The sides of the box that a vertex lies on: bit s stands for side s. Bit 7 marks a vertex that never moves.
using SideSet = std::uint8_t;
inline constexpr SideSet kBoxSides = (1 << kHull) - 1, kOnHull = 1 << kHull, kPinned = 1 << 7;

}  // namespace regionmesh
