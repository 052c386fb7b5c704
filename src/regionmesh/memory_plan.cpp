#include "regionmesh/memory_plan.h"

#include <algorithm>
#include <string>

#include "regionmesh/base/error.h"
#include "regionmesh/tile/tiles.h"

namespace regionmesh {

std::uint64_t reading_bytes(const VolumeInfo& volume) {
    const std::uint64_t width = volume.lattice.size[volume.sweep.axes[0]],
                        height = volume.lattice.size[volume.sweep.axes[1]];
    // The section as read, two with dense labels, two planes of six vertex numbers, and what the reader holds; and the
    // faces and vertices of a run, at one face a sample.
    const std::uint64_t run = plan_tiles(volume.lattice, volume.sweep).run_strips;
    return width * height * (8 + 2 * 4 + 2 * 24 + 8 + run * (sizeof(BatchFace) + sizeof(BatchVertex) / 2)) +
           (std::uint64_t{16} << 20);
}

std::uint64_t face_budget_for(std::uint64_t memory, const VolumeInfo& volume, std::uint64_t smoothing) {
    const std::uint64_t reading = reading_bytes(volume) + smoothing;
    if (memory < reading + (std::uint64_t{1} << 20))
        throw Error(ErrorCode::kInput, "--memory " + std::to_string(memory >> 20) + " MiB: the sections of " +
                                           volume.source + " that are held at a time take " +
                                           std::to_string((reading >> 20) + 1) +
                                           " MiB; give more, another --sweep, or a smaller --smooth");
    return std::min((memory - reading) / kBytesPerFace, kMostFaces);
}

}  // namespace regionmesh
