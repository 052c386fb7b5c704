// How memory is shared out: what a run needs at each moment, and how many faces the model may have then.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Most faces that a model can have: they are numbered in 32 bits.
inline constexpr std::uint64_t kMostFaces = std::numeric_limits<std::uint32_t>::max();

/// Bytes a face, each with half a vertex (docs/memory.md): of the model; of the model while it is decimated.
inline constexpr std::uint64_t kMeshBytesPerFace = 48, kBytesPerFace = 96;

/// What the plan has to know of a run.
struct MemoryDemand {
    std::string source;  // for messages
    Lattice lattice;     // of which tiles are cut
    Sweep sweep;
    std::uint64_t reading_bytes = 0;          // that the process, reading and meshing take beside the model
    std::vector<std::uint64_t> strip_faces;   // by strip, unsimplified: counted, or a guess
    std::uint32_t window_strips = 0;          // that smoothing holds at most; 0: none
    std::uint64_t window_bytes_per_face = 0;  // that it takes for them
    std::uint32_t run_strips = 1;             // strips gathered before they join the model, if memory allows
    std::uint32_t fewest_run_strips = 1;      // and if it does not
    double target_share = 1;                  // of all faces, that the model keeps
    double tile_share = 1;                    // of a run's faces that its tiles may leave; 1: there are no tiles
    bool is_decimating = false;
    bool preserves_volume = false;
    std::optional<std::uint64_t> asked_budget = {};  // faces held at once, whatever memory says
};

/// Bytes beside the model while a run of strips is gathered and worked on, and once it has joined the model.
struct RunMemory {
    std::uint64_t faces_before, faces;  // unsimplified: of the strips before, and of its own
    std::uint64_t gathering, joined;
};

/// The moment that needs most.
struct MemoryNeed {
    std::uint64_t reading = 0;  // the process, the sections held, their tables
    std::uint64_t window = 0;   // of smoothing
    std::uint64_t run = 0;      // of strips, and its tiles
    std::uint64_t mesh = 0;     // with what decimates or checks it
    std::uint64_t sum() const { return reading + window + run + mesh; }
};

/// A plan that follows from sizes, counts and options, never from threads or from what memory is free.
struct MemoryPlan {
    std::uint64_t memory = 0;      // bytes to stay within
    std::uint32_t run_strips = 1;  // the demand's, unless only shorter runs fit
    std::uint32_t in_flight = 1;   // tiles out of their batch at a time, unless only fewer fit
    std::vector<RunMemory> runs;
    MemoryNeed least;                                // what would just do; more than `memory`: it cannot be kept
    std::optional<std::uint64_t> asked_budget = {};  // faces held at once, whatever memory says

    bool holds() const { return asked_budget || least.sum() <= memory; }
    /// Faces that the model may have when a run has joined it, and while it is decimated then.
    std::uint64_t face_budget(std::size_t run) const;
    /// Faces that the model may have while a run is gathered, which will bring `run_faces`.
    std::uint64_t room_before(std::size_t run, std::uint64_t run_faces) const;
    /// Faces that a run will bring, when the one before it brought `run_faces`.
    std::uint64_t expected_faces(std::size_t run, std::uint64_t run_faces) const;
};

MemoryPlan plan_memory(std::uint64_t memory, const MemoryDemand& demand);

/// Throws Error(kInput) where the plan does not hold: in one line, how much would, what for, and what to change.
void require_memory(const MemoryPlan& plan, const MemoryDemand& demand);

/// The program and its libraries, and buffers of reading and writing.
inline constexpr std::uint64_t kProcessBytes = std::uint64_t{20} << 20;

/// As many faces as samples in each strip, where nobody has counted.
std::vector<std::uint64_t> guessed_strip_faces(const Lattice& lattice, Sweep sweep);

/// Bytes that the process, reading and meshing of a volume take beside the model.
std::uint64_t reading_bytes(const VolumeInfo& volume);

}  // namespace regionmesh
