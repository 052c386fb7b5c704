#include "stream/memory_plan.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/megabytes.h"
#include "regionmesh/error.h"
#include "regionmesh/memory.h"
#include "simplify/tiles.h"

namespace regionmesh {
namespace {

/// The model, a face, while it is sorted or decimated, with places that are free in between.
constexpr std::uint64_t kWorkBytesPerFace = 100;

/// Beside the model, a face: of a run; of a run that is sorted into tiles and put together again; of a tile out of it.
constexpr std::uint64_t kRunBytesPerFace = 40, kTilesBytesPerFace = 24, kTileBytesPerFace = 100;

/// Where memory is short, so few are out of it.
constexpr std::uint32_t kFewestInFlight = 4;

/// Beside the model, a face: of what checks it; of what gives it its volumes back.
constexpr std::uint64_t kCheckBytesPerFace = 20, kPreserveBytesPerFace = 100;

/// Faces of the strips from `first` to before `end`, for all windows of strips.
class StripSums {
public:
    explicit StripSums(const std::vector<std::uint64_t>& faces) : sums_(1, 0) {
        for (std::uint64_t count : faces) sums_.push_back(sums_.back() + count);
    }
    std::uint64_t size() const { return sums_.size() - 1; }
    std::uint64_t operator()(std::uint64_t first, std::uint64_t end) const {
        return sums_[std::min(end, size())] - sums_[std::min(first, size())];
    }

private:
    std::vector<std::uint64_t> sums_;
};

std::uint64_t share_of(std::uint64_t faces, double share) {
    return static_cast<std::uint64_t>(std::ceil(static_cast<double>(faces) * share));
}

/// What a run of strips takes while it is worked on, a face.
std::uint64_t run_bytes_per_face(const MemoryDemand& demand, std::uint32_t tiles_in_flight) {
    if (demand.tile_share >= 1) return kRunBytesPerFace;
    std::uint64_t tiles = 1;
    const TilePlan plan = plan_tiles(demand.lattice, demand.sweep);
    for (int a = 0; a < 2; ++a)
        tiles *= (demand.lattice.size[demand.sweep.axes[a]] + plan.tile_cells - 1) / plan.tile_cells;
    // Some have half as many faces again as the average.
    const std::uint64_t in_flight = std::min<std::uint64_t>(tiles, tiles_in_flight + tiles_in_flight / 2);
    return kRunBytesPerFace + kTilesBytesPerFace + kTileBytesPerFace * in_flight / tiles;
}

/// Bytes of the window when all strips before this one are out of it.
std::uint64_t window_at(const MemoryDemand& demand, const StripSums& faces, std::uint64_t strip) {
    return faces(strip, strip + demand.window_strips) * demand.window_bytes_per_face;
}

MemoryPlan plan_runs(std::uint64_t memory, const MemoryDemand& demand, std::uint32_t run_strips,
                     std::uint32_t in_flight) {
    MemoryPlan plan{.memory = memory,
                    .run_strips = run_strips,
                    .in_flight = in_flight,
                    .runs = {},
                    .least = {},
                    .asked_budget = demand.asked_budget};
    const StripSums faces(demand.strip_faces);
    const std::uint64_t reading = demand.reading_bytes, per_face = run_bytes_per_face(demand, in_flight);
    const std::uint64_t working = demand.is_decimating ? kWorkBytesPerFace : kMeshBytesPerFace;
    const auto note = [&](const MemoryNeed& need) {
        if (need.sum() > plan.least.sum()) plan.least = need;
    };
    for (std::uint64_t first = 0; first < faces.size(); first += run_strips) {
        const std::uint64_t end = std::min(first + run_strips, faces.size());
        const std::uint64_t before = faces(0, first), own = faces(first, end);
        std::uint64_t window = 0;
        for (std::uint64_t strip = first; strip < end; ++strip)
            window = std::max(window, window_at(demand, faces, strip));
        const std::uint64_t window_after = window_at(demand, faces, end), run = own * per_face;
        plan.runs.push_back({before, own, reading + window + run, reading + window_after});
        const std::uint64_t kept = share_of(before, demand.target_share), left = share_of(own, demand.tile_share);
        note({reading, window, run, kept * kMeshBytesPerFace});
        note({reading, window_after, 0, (kept + left) * working});
    }
    const std::uint64_t last =
        kMeshBytesPerFace + std::max(kCheckBytesPerFace, demand.preserves_volume ? kPreserveBytesPerFace : 0);
    note({kProcessBytes, 0, 0, share_of(faces(0, faces.size()), demand.target_share) * last});
    return plan;
}

}  // namespace

std::uint64_t MemoryPlan::face_budget(std::size_t run) const {
    if (asked_budget) return std::min(*asked_budget, kMostFaces);
    return std::min((memory - std::min(memory, runs[run].joined)) / kWorkBytesPerFace, kMostFaces);
}

std::uint64_t MemoryPlan::room_before(std::size_t run, std::uint64_t run_faces) const {
    const std::uint64_t after = face_budget(run), room = after - std::min(after, run_faces);
    if (asked_budget) return room;
    return std::min(room, (memory - std::min(memory, runs[run].gathering)) / kMeshBytesPerFace);
}

std::uint64_t MemoryPlan::expected_faces(std::size_t run, std::uint64_t run_faces) const {
    const double growth =
        static_cast<double>(runs[run].faces) / static_cast<double>(std::max<std::uint64_t>(runs[run - 1].faces, 1));
    return std::min(runs[run].faces, static_cast<std::uint64_t>(std::ceil(growth * static_cast<double>(run_faces))));
}

/// Fewer tiles in flight do not change the result: that comes first.
MemoryPlan plan_memory(std::uint64_t memory, const MemoryDemand& demand) {
    MemoryPlan plan = plan_runs(memory, demand, demand.run_strips, kTilesInFlight);
    for (std::uint32_t strips = demand.run_strips; !plan.holds() && strips >= demand.fewest_run_strips; strips /= 2)
        if (MemoryPlan leaner = plan_runs(memory, demand, strips, kFewestInFlight);
            leaner.least.sum() < plan.least.sum())
            plan = std::move(leaner);
    return plan;
}

void require_memory(const MemoryPlan& plan, const MemoryDemand& demand) {
    if (plan.holds()) return;
    const MemoryNeed& need = plan.least;
    std::string text = "--memory " + megabytes(plan.memory) + ": " + demand.source + " needs at least " +
                       megabytes(need.sum()) + ": " + megabytes(need.reading) + " for reading, ";
    if (need.window > 0) text += megabytes(need.window) + " for smoothing, ";
    if (need.run > 0) text += megabytes(need.run) + " for a run of strips, ";
    text += megabytes(need.mesh) + " for the model; give so much";
    if (need.mesh > need.sum() / 2) text += demand.is_decimating ? ", or a lower target" : ", or a target";
    if (need.window > need.sum() / 4) text += ", or a smaller --smooth";
    if (need.mesh <= need.sum() / 2) text += ", or another --sweep";
    throw Error(ErrorCode::kInput, text);
}

std::vector<std::uint64_t> guessed_strip_faces(const Lattice& lattice, Sweep sweep) {
    const auto& size = lattice.size;
    const auto& axes = sweep.axes;
    const std::uint64_t strips = std::max(size[axes[2]], 1u) - 1;
    return std::vector<std::uint64_t>(strips, std::uint64_t{size[axes[0]]} * size[axes[1]]);
}

std::uint64_t reading_bytes(const VolumeInfo& volume) {
    const std::uint64_t samples =
        std::uint64_t{volume.lattice.size[volume.sweep.axes[0]]} * volume.lattice.size[volume.sweep.axes[1]];
    // The section as read, the one read ahead, two with dense labels, and two planes of six vertex numbers.
    const std::uint64_t held = volume.held_bytes ? volume.held_bytes : samples * 8;
    return kProcessBytes + held + samples * (8 + 8 + 2 * 4 + 2 * 24);
}

std::uint64_t expected_bytes(const VolumeInfo& volume, std::uint64_t faces) {
    return reading_bytes(volume) + faces * kBytesPerFace;
}

}  // namespace regionmesh
