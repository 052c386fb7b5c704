// How --memory is shared out: the bytes needed at each moment, and how many faces the mesh may have then.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/limits.h"

namespace regionmesh {

/// All that the budget depends on.
struct BudgetDemand {
    std::string source;                       // for messages
    std::uint64_t reading_bytes = 0;          // of the process, reading and meshing
    std::vector<std::uint64_t> strip_faces;   // of each strip before simplification: counted, or a guess
    std::vector<std::uint64_t> window_bytes;  // of each strip while smoothing holds it
    std::uint32_t window_strips = 0;          // that smoothing holds at most; 0 without smoothing
    std::uint32_t chunk_strips = 1;           // strips gathered before they are merged, if memory allows
    std::uint32_t fewest_chunk_strips = 1;    // and if it does not
    std::uint32_t tiles = 1;                  // tiles of a chunk
    std::uint32_t tiles_in_flight = 16;       // worked on at a time, if memory allows
    double target_share = 1;                  // of all faces, that the mesh keeps
    double tile_share = 1;                    // of the faces of a chunk that its tiles may leave; 1: no tiles
    bool is_decimating = false;
    bool preserves_volume = false;
    std::optional<std::uint64_t> asked_budget = {};  // most faces held at once, whatever memory says
};

/// Bytes in addition to the mesh while a chunk of strips is gathered and its tiles are decimated, of these the bytes of
/// the chunk and its tiles, and bytes once it is merged.
struct ChunkMemory {
    std::uint64_t faces_before, faces;  // before simplification: of the strips before, and of its own
    std::uint64_t gathering, tiles, merged;
};

/// The moment that needs most.
struct MemoryNeed {
    std::uint64_t reading = 0;  // the process, the sections held, their tables
    std::uint64_t window = 0;   // of smoothing
    std::uint64_t chunk = 0;    // of strips, and its tiles
    std::uint64_t mesh = 0;     // with what decimates or checks it
    std::uint64_t sum() const { return reading + window + chunk + mesh; }
};

/// Follows from sizes, counts and options, never from threads or from the memory that is free.
struct Budget {
    /// Memory beyond the plan that is room enough to keep freed memory: half of the plan, and so many bytes.
    static constexpr std::uint64_t kLeastRoom = std::uint64_t{32} << 20;

    std::uint64_t memory = 0;        // bytes to stay within
    std::uint32_t chunk_strips = 1;  // as demanded, unless only shorter chunks fit
    std::uint32_t in_flight = 1;     // tiles worked on at a time, as demanded unless only fewer fit
    double share_in_flight = 1;      // of the faces of a chunk that these tiles may hold
    std::vector<ChunkMemory> chunks;
    MemoryNeed least;                    // the least memory that is enough
    std::uint64_t in_the_end = 0;        // bytes of the process with the model, which it holds in any case
    bool is_largest_in_the_end = false;  // no chunk needs more while it is gathered
    // Faces, as demanded; or more, where the model cannot be kept to the budget.
    std::optional<std::uint64_t> asked_budget = {};

    bool holds() const { return asked_budget || least.sum() <= memory; }
    /// True if there is less room than that: freed memory must be given back at once.
    bool is_short() const { return least.sum() + std::max(least.sum() / 2, kLeastRoom) > memory; }
    /// Faces that the mesh may have when a chunk is merged, and while it is decimated then.
    std::uint64_t face_budget(std::size_t chunk) const;
    /// Faces that the mesh may have while a chunk is gathered that will bring `chunk_faces`.
    std::uint64_t room_before(std::size_t chunk, std::uint64_t chunk_faces) const;
    /// True if the next chunk can be gathered while the tiles of this one are decimated, beside a model of
    /// `model_faces`.
    bool has_room_ahead(std::size_t chunk, std::uint64_t model_faces) const;
    /// Faces that a chunk will bring if the one before it brought `chunk_faces`.
    std::uint64_t expected_faces(std::size_t chunk, std::uint64_t chunk_faces) const;
};

Budget plan_budget(std::uint64_t memory, const BudgetDemand& demand);

/// Throws Error(kInput) where the budget does not hold: one line with the memory needed, its parts, and what to change.
void require_budget(const Budget& budget, const BudgetDemand& demand);

}  // namespace regionmesh
