// The axis along which a volume is read.
#pragma once

#include <optional>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// The sweep that `choice` asks for, out of those that `volume` can do; nullopt if it cannot do it. Smaller sections
/// need less memory, so kAuto takes the axis with the smallest section (P 3.1), z before y before x.
std::optional<Sweep> choose_sweep(const VolumeInfo& volume, SweepChoice choice);

/// Samples of one section.
std::uint64_t section_samples(const VolumeInfo& volume, const Sweep& sweep);

}  // namespace regionmesh
