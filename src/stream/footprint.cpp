#include "stream/footprint.h"

#include "cells/strip_mesher.h"

namespace regionmesh {

std::uint64_t reading_bytes(const VolumeInfo& volume) {
    const std::uint64_t samples =
        std::uint64_t{volume.lattice.size[volume.sweep.axes[0]]} * volume.lattice.size[volume.sweep.axes[1]];
    const std::uint64_t held = volume.held_bytes ? volume.held_bytes : samples * sizeof(InputLabel);
    // The section as read, the one read ahead, two with dense labels, and the tables of the mesher.
    constexpr std::uint64_t kPerSample = 2 * sizeof(InputLabel) + 2 * sizeof(Label) + StripMesher::kBytesPerSample;
    static_assert(kPerSample == 72);
    return kProcessBytes + held + samples * kPerSample;
}

}  // namespace regionmesh
