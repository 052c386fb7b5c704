// From labelled sections, or tetrahedra, to a checked mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "regionmesh/census.h"
#include "regionmesh/denoise.h"
#include "regionmesh/label_table.h"
#include "regionmesh/limits.h"
#include "regionmesh/mesh.h"
#include "regionmesh/promises.h"
#include "regionmesh/report.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh {

/// Options of a run. The words are those of the command line.
struct ReconstructOptions {
    std::optional<std::uint64_t> target_faces = {};  // decimate to this number of faces or fewer
    std::optional<double> reduce = {};               // or remove this share of the faces, 0 to 1
    Promises promises = {};  // what decimation, remeshing, smooth lines and improvement keep; smoothing keeps quality
                             // and crossings. A largest error asks for decimation, too. Its scale, box and samples are
                             // set from the run; where it has no bound on quality, decimation of sections, unless with
                             // improve or preserve_volume, keeps usual_quality_bound (docs/explanation/decimate.md)
    double room = 0;  // of sections: samples nearer than this to the boundary of their region, in finest spacings, may
                      // change their label first, for noisy labels (docs/explanation/smoothing.md); at most 8; 0: none
    DenoiseOptions denoise{.distance = 0};  // of sections: rough labels are made smoother first, with the topology that
                                            // they have. Its threads are set from the run; off with `room`
    CellKind cells = CellKind::kAuto;       // of sections: how they are meshed
    double scale_z = 1;  // of sections: z is multiplied by the nearest power of two while positions, costs, qualities
                         // and errors are computed; the model is not scaled. Tetrahedra have their own
    SmoothOptions smooth = {};                          // its scale, quality, tests and threads are set from the run
    double perturbation = 1e-7;                         // of costs: share of scale^4, hashed from the edge (P 4.5)
    PlacementKind placement = PlacementKind::kQuadric;  // where collapses put merged vertices
    bool keep_samples = true;                           // of sections: decimation carries no sample into another region
    std::optional<double> edge_length = {};             // a pass that brings all edges near this length (remesh.h)
    bool smooth_lines = false;                          // a pass that smooths lines of three regions
    bool improve = false;                               // a last pass that makes faces better, for finite elements
    bool preserve_volume = false;           // finally give each region its volume before smoothing and decimation
    double free_error = 0;                  // without a target or a largest error: faces go that decimation can spare
                                            // within this distance, a length; 0: none. No promise: what follows, such
                                            // as raise_floor(), may go farther
    bool decimate = true;                   // false: no decimation, even with a target
    bool cap = true;                        // --boundary cap; false: open
    std::vector<InputLabel> background{0};  // empty space: its faces with the exterior are not made
    std::uint64_t memory = kDefaultMemory;  // bytes that the work is planned for (docs/explanation/memory.md)
    std::optional<std::uint64_t> face_budget = {};  // most faces held at once, instead of deriving it from memory
    std::uint32_t threads = 0;                      // 0: one per core. The result does not depend on it
    std::uint32_t strips_per_chunk = 1;  // strips meshed before they are merged; decimation in tiles sets its own
    std::optional<Sweep> sweep = {};     // of tetrahedra; default: along the longest side. Sections have their own
};

/// State of a run, for a progress line.
struct Progress {
    const char* stage = "";
    std::uint32_t strips_read = 0, strip_count = 0;
    std::uint64_t faces_read = 0, faces_held = 0;
    double share = 0;                // of the work of all stages, estimated, 0 to 1; begins again where smoothing does
    std::uint64_t bytes_needed = 0;  // of memory, estimated, once topology or the largest error are found to leave more
                                     // faces than the memory of the options has room for; 0 before that
};

struct Reconstruction {
    Mesh mesh;
    LabelTable labels;
    std::vector<Label> background;  // dense
    Report report;
};

/// Called on the calling thread. The last share may be a little below 1.
using OnProgress = std::function<void(const Progress&)>;

/// Receives the finished model and its dense background labels, to write it or show it. With more than one thread, and
/// memory for both, it is called on another thread while this one checks the model; otherwise after the check.
using OnModel = std::function<void(const Mesh&, const LabelTable&, const std::vector<Label>& background)>;

/// How sections are meshed with these options: kCompact or kTetrahedra.
CellKind cell_kind(const ReconstructOptions& options);

/// The least ReconstructOptions::memory, in bytes, with which reconstruct() accepts the volume. The census was taken of
/// the same volume, after ReconstructOptions::room, with the same caps, background and cells.
std::uint64_t least_memory(const VolumeInfo& volume, const Census& census, const ReconstructOptions& options);

/// The sections with the labels that reconstruct() gives to its model: as ReconstructOptions::room, or else
/// ReconstructOptions::denoise, changes them; `reader` itself where neither is asked for. For what is compared with
/// such a model.
std::unique_ptr<SectionReader> modelled_sections(std::unique_ptr<SectionReader> reader,
                                                 const ReconstructOptions& options);

/// Reads all sections, builds the mesh on the fly within the memory, decimates it to the target and checks it. Sections
/// that can be read twice are read first to count faces and to plan memory. With more than one thread, the reader is
/// called on a thread of its own, one call at a time. A reader that can be rewound is rewound first; another one begins
/// where it is. Throws Error(kUsage) for options out of range, Error(kInput) for a volume with fewer than two samples
/// along an axis and, after the first pass, for a target that does not fit in the memory; and whatever the reader or
/// `on_model` throws. Deterministic.
Reconstruction reconstruct(SectionReader& reader, const ReconstructOptions& options = {},
                           const OnProgress& on_progress = {}, const OnModel& on_model = {});

/// The same from labelled tetrahedra (P 3.9). They are sorted along the sweep; their faces are spilled to disk (in
/// TMPDIR) and read back in order, so that memory holds all points, but only the active tetrahedra. Lengths and
/// qualities are measured with z scaled; the mesh is checked as it is written, without the scale. Throws Error(kInput)
/// for invalid tetrahedra, Error(kOutput) for a full disk, and whatever the reader or `on_model` throws.
Reconstruction reconstruct(TetrahedronReader& reader, const ReconstructOptions& options = {},
                           const OnProgress& on_progress = {}, const OnModel& on_model = {});

}  // namespace regionmesh
