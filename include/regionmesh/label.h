// Labels: 64-bit as the input has them, dense 32-bit inside.
#pragma once

#include <cstdint>

namespace regionmesh {

/// A label as the input holds it, bit for bit; unsigned 64-bit labels keep their bits (see LabelTable).
using InputLabel = std::int64_t;

/// A dense label: regions count from 0 in order of first appearance; the six sides of the sampled box stand at the top.
using Label = std::uint32_t;

inline constexpr Label kFirstExterior = 0xFFFFFFF0u;

/// The exterior beyond one side of the box; sides are 0..5 = x low, x high, y low, y high, z low, z high. Where
/// tetrahedra fill no box, all of the exterior is beyond their hull.
inline constexpr int kHull = 6, kSideCount = 7;
constexpr Label exterior(int side) { return kFirstExterior + static_cast<Label>(side); }
constexpr bool is_exterior(Label label) { return label >= kFirstExterior; }
constexpr int side_of(Label label) { return static_cast<int>(label - kFirstExterior); }

/// Sides that a vertex lies on as a set of bits, bit s for side s. One more says that it stays as it is for good.
using SideSet = std::uint8_t;
inline constexpr SideSet kOnHull = 1 << kHull, kPinned = 1 << 7;

}  // namespace regionmesh
