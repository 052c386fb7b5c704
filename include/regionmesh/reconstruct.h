// The whole way from sections, or tetrahedra, to a checked model.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/report.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/smooth_options.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

/// What a run is asked for. The words are those of the command line.
struct ReconstructOptions {
    std::optional<std::uint64_t> target_faces = {};  // decimate to at most so many faces
    std::optional<double> reduce = {};               // or remove this share of them, 0 to 1
    std::optional<double> max_error = {};            // or as far as the rms distance allows, in the unit of the spacing
    SmoothOptions smooth = {};                       // scale, quality, tests and threads are those of the run
    double min_quality = 0.1;                        // of every face that smoothing or decimation touches
    double perturbation = 1e-7;                      // P 4.5
    bool preserve_volume = false;  // in the end, give every region the volume it had before smoothing and decimation
    bool decimate = true;          // false: the plain reconstruction, whatever the targets say
    bool intersect_check = true;
    bool cap = true;                                // --boundary cap; false: open
    std::vector<InputLabel> background{0};          // empty space: its faces with the exterior are not made
    std::uint64_t memory = std::uint64_t{2} << 30;  // bytes that the process is to stay within
    std::optional<std::uint64_t> face_budget = {};  // most faces held at once, instead of one derived from memory
    std::uint32_t threads = 0;                      // at work at a time; 0: one per core. The result is the same
    std::uint32_t strips_per_chunk = 1;  // strips meshed before they are merged; tiles set it where there are any
    std::optional<Sweep> sweep = {};     // of tetrahedra, along the longest side if not given; sections have their own
};

/// Where a run is; for a progress line.
struct Progress {
    const char* stage = "";
    std::uint32_t strips_read = 0, strip_count = 0;
    std::uint64_t faces_read = 0, faces_held = 0;
};

struct Reconstruction {
    Mesh mesh;
    LabelTable labels;
    std::vector<Label> background;  // dense
    Report report;
};

/// Reads all sections, builds the model on the fly within its memory, decimates it to the target and checks it. Reads
/// them twice where that is possible, first to count faces and to plan memory; with more than one thread on a thread of
/// its own, one call at a time. Throws Error(kInput) for a volume with fewer than two samples along an axis, and what
/// the reader throws; after the first pass Error(kInput) for a target beyond what memory allows. Deterministic.
Reconstruction reconstruct(SectionReader& reader, const ReconstructOptions& options = {},
                           const std::function<void(const Progress&)>& on_progress = {});

/// The same from labelled tetrahedra (P 3.9): they are sorted along the sweep, their faces put aside on disk (in
/// TMPDIR) and read back in order, so that memory holds the points, but no more of the tetrahedra than of sections.
/// Lengths and qualities are those of the space in which z is scaled; the model is checked as it is written, without
/// that. Throws what rank_tetrahedra() and the reader throw, and Error(kOutput) for a full disk.
Reconstruction reconstruct(TetrahedronReader& reader, const ReconstructOptions& options = {},
                           const std::function<void(const Progress&)>& on_progress = {});

}  // namespace regionmesh
