#include "volume/choose_sweep.h"

namespace regionmesh {
namespace {

constexpr std::array<Sweep, 3> kSweeps{kSweepX, kSweepY, kSweepZ};

}  // namespace

std::uint64_t section_samples(const VolumeInfo& volume, const Sweep& sweep) {
    return std::uint64_t{volume.lattice.size[sweep.axes[0]]} * volume.lattice.size[sweep.axes[1]];
}

std::optional<Sweep> choose_sweep(const VolumeInfo& volume, SweepChoice choice) {
    if (choice != SweepChoice::kAuto) {
        const int axis = choice == SweepChoice::kX ? 0 : choice == SweepChoice::kY ? 1 : 2;
        return volume.can_sweep[axis] ? std::optional(kSweeps[axis]) : std::nullopt;
    }
    Sweep best = kSweepZ;
    for (const int axis : {1, 0})
        if (volume.can_sweep[axis] && section_samples(volume, kSweeps[axis]) < section_samples(volume, best))
            best = kSweeps[axis];
    return best;
}

}  // namespace regionmesh
