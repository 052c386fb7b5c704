// How one section lies against another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/prepare_sections.h"

namespace regionmesh {

/// The motion of a section after which most of its samples agree with the next: sample (x, y) of the first lies at the
/// turned (x, y), about the middle, plus the shift. By hill climbing from no motion, so that it finds motions of up to
/// about the size of the parts; a fraction of a sample is estimated. No motion where none is better. Looks at about
/// 65,000 samples.
SectionShift estimate_shift(std::span<const InputLabel> from, std::span<const InputLabel> to, std::int32_t width,
                            AlignKind kind);

/// What is left of the sum of these shifts without its trend, one more than `shifts`: a straight line is fitted to the
/// nine sections around each.
std::vector<SectionShift> without_trend(std::span<const SectionShift> shifts);

}  // namespace regionmesh
