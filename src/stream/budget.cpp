#include "stream/budget.h"

#include <algorithm>
#include <cmath>

#include "base/megabytes.h"
#include "regionmesh/error.h"
#include "stream/footprint.h"
#include "stream/tuning.h"

namespace regionmesh {
namespace {

/// Sums of a number of each strip, over the strips from `first` to before `end`.
class StripSums {
public:
    explicit StripSums(const std::vector<std::uint64_t>& numbers) : sums_(1, 0) {
        for (std::uint64_t number : numbers) sums_.push_back(sums_.back() + number);
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

/// Share of the faces of a chunk that tiles in flight may hold: half as many again as the average. Where faces crowd in
/// few tiles, fewer of them are in flight.
double share_in_flight(const BudgetDemand& demand, std::uint32_t tiles_in_flight) {
    return std::min(1.5 * tiles_in_flight / demand.tiles, 1.0);
}

/// Bytes per face of a chunk of strips while it is worked on.
std::uint64_t chunk_bytes_per_face(const BudgetDemand& demand, std::uint32_t tiles_in_flight) {
    if (demand.tile_share >= 1) return kChunkBytesPerFace;
    return kChunkBytesPerFace + kTilesBytesPerFace +
           static_cast<std::uint64_t>(static_cast<double>(kTileBytesPerFace) *
                                      share_in_flight(demand, tiles_in_flight));
}

Budget plan_chunks(std::uint64_t memory, const BudgetDemand& demand, std::uint32_t chunk_strips,
                   std::uint32_t in_flight) {
    Budget budget{.memory = memory,
                  .chunk_strips = chunk_strips,
                  .in_flight = in_flight,
                  .share_in_flight = share_in_flight(demand, in_flight),
                  .chunks = {},
                  .least = {},
                  .in_the_end = {},
                  .is_largest_in_the_end = {},
                  .asked_budget = demand.asked_budget};
    const StripSums faces(demand.strip_faces), window_of(demand.window_bytes);
    // When all strips before this one have left the window.
    const auto window_at = [&](std::uint64_t strip) { return window_of(strip, strip + demand.window_strips); };
    const std::uint64_t reading = demand.reading_bytes, per_face = chunk_bytes_per_face(demand, in_flight);
    const std::uint64_t working = demand.is_decimating ? kWorkBytesPerFace : kMeshBytesPerFace;
    const auto note = [&](const MemoryNeed& need) {
        if (need.sum() > budget.least.sum()) budget.least = need;
        return need.sum();
    };
    std::uint64_t most_gathering = 0, last_merged = 0;
    for (std::uint64_t first = 0; first < faces.size(); first += chunk_strips) {
        const std::uint64_t end = std::min(first + chunk_strips, faces.size());
        const std::uint64_t before = faces(0, first), own = faces(first, end);
        std::uint64_t window = 0;
        for (std::uint64_t strip = first; strip < end; ++strip) window = std::max(window, window_at(strip));
        const std::uint64_t window_after = window_at(end), chunk = own * per_face;
        budget.chunks.push_back({before, own, reading + window + chunk, chunk, reading + window_after});
        const std::uint64_t kept = share_of(before, demand.target_share), left = share_of(own, demand.tile_share);
        most_gathering = std::max(most_gathering, note({reading, window, chunk, kept * kChunkBytesPerFace}));
        last_merged = note({reading, window_after, 0, (kept + left) * working});
    }
    const std::uint64_t last =
        kMeshBytesPerFace + std::max(kCheckBytesPerFace, demand.preserves_volume ? kPreserveBytesPerFace : 0);
    const std::uint64_t left = share_of(faces(0, faces.size()), demand.target_share);
    budget.in_the_end = note({kProcessBytes, 0, 0, left * last});
    if (demand.target_share < 1) budget.in_the_end = kProcessBytes + left * std::max(last, kBytesPerFace);
    budget.is_largest_in_the_end = most_gathering <= last_merged;
    return budget;
}

}  // namespace

std::uint64_t Budget::face_budget(std::size_t chunk) const {
    if (asked_budget) return std::min(*asked_budget, kMostFaces);
    return std::min((memory - std::min(memory, chunks[chunk].merged)) / kWorkBytesPerFace, kMostFaces);
}

std::uint64_t Budget::room_before(std::size_t chunk, std::uint64_t chunk_faces) const {
    const std::uint64_t after = face_budget(chunk), room = after - std::min(after, chunk_faces);
    if (asked_budget) return room;
    return std::min(room, (memory - std::min(memory, chunks[chunk].gathering)) / kChunkBytesPerFace);
}

bool Budget::has_room_ahead(std::size_t chunk, std::uint64_t model_faces) const {
    if (asked_budget || chunk + 1 >= chunks.size()) return false;
    const ChunkMemory &now = chunks[chunk], &next = chunks[chunk + 1];
    const std::uint64_t reading_and_window = std::max(now.gathering - now.tiles, next.gathering - next.tiles);
    return reading_and_window + now.tiles + (model_faces + next.faces) * kChunkBytesPerFace <= memory;
}

std::uint64_t Budget::expected_faces(std::size_t chunk, std::uint64_t chunk_faces) const {
    const double growth = static_cast<double>(chunks[chunk].faces) /
                          static_cast<double>(std::max<std::uint64_t>(chunks[chunk - 1].faces, 1));
    return std::min(chunks[chunk].faces,
                    static_cast<std::uint64_t>(std::ceil(growth * static_cast<double>(chunk_faces))));
}

/// Tries fewer tiles in flight before shorter chunks: only the latter change the result.
Budget plan_budget(std::uint64_t memory, const BudgetDemand& demand) {
    Budget budget = plan_chunks(memory, demand, demand.chunk_strips, demand.tiles_in_flight);
    for (std::uint32_t strips = demand.chunk_strips; !budget.holds() && strips >= demand.fewest_chunk_strips;
         strips /= 2)
        if (Budget leaner = plan_chunks(memory, demand, strips, stream::kFewestInFlight);
            leaner.least.sum() < budget.least.sum())
            budget = std::move(leaner);
    return budget;
}

void require_budget(const Budget& budget, const BudgetDemand& demand) {
    if (budget.holds()) return;
    const MemoryNeed& need = budget.least;
    std::string text = memory_limit_text(budget.memory) + ": " + demand.source + " needs at least " +
                       megabytes(need.sum()) + ": " + megabytes(need.reading) + " for reading, ";
    if (need.window > 0) text += megabytes(need.window) + " for smoothing, ";
    if (need.chunk > 0) text += megabytes(need.chunk) + " for a chunk of strips, ";
    text += megabytes(need.mesh) + " for the model; raise --memory to that";
    if (need.mesh > need.sum() / 2) text += demand.is_decimating ? ", or set a lower target" : ", or set a target";
    if (need.window > need.sum() / 4) text += ", or lower --smooth";
    if (need.mesh <= need.sum() / 2) text += ", or change --sweep";
    throw Error(ErrorCode::kInput, text);
}

}  // namespace regionmesh
