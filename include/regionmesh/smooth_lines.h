// Smoother lines between three regions, on the finished surface.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/simplify.h"

namespace regionmesh {

struct SmoothLinesOptions {
    double scale = 1;             // the sample spacing, or typical_edge(mesh); no vertex moves farther than this
    double min_quality = 0.1;     // of the faces that are changed; a star with faces below may keep as many
    double max_error = HUGE_VAL;  // limit of SmoothLinesResult::error_bound, as of SimplifyOptions
    std::uint32_t sweeps = 8;     // at most, over all vertices of lines
    std::uint32_t threads = 0;    // at work at a time; 0: one per core. The result is the same
    std::optional<Lattice> samples = {};     // no sample of it changes its region; as of SimplifyOptions
    std::optional<Box> box = {};             // no vertex leaves it; as of SimplifyOptions
    double scale_z = 1;                      // by which z of the mesh is multiplied: turns are measured without it
    std::function<void()> on_progress = {};  // called now and then, on the calling thread
};

/// To smooth the lines of what was simplified: the same scale, samples, bounds and threads.
SmoothLinesOptions smooth_lines_options(const SimplifyOptions& simplified);

struct SmoothLinesResult {
    std::uint64_t vertices = 0;  // of lines, and where four meet, that may move
    std::uint64_t moves = 0;
    std::uint32_t sweeps = 0;
    double turn_before = 0, turn_after = 0;  // mean angle between their edges along a line, in degrees
    double largest_displacement = 0;         // length, with z scaled
    double error_bound = 0;                  // of simplify() and this together (SimplifyResult)
};

/// Moves the vertices of lines (edges between three regions, or between two on a side of the box), and of points where
/// four meet, to where the lines turn least: each toward the least sum of squared turns over lengths, a discrete
/// bending energy, and of a small share of its squared distance from where it was (docs/explanation/smoothing.md).
/// Each step passes the tests of a collapse (fold, quality, pinch, intersect, and samples where a lattice is given): no
/// violation is added, strata stay, and vertices stay on their sides of the box; those on its edges do not move.
/// Deterministic. Requires that every vertex that is not fixed has all its faces in the mesh. Throws like simplify().
SmoothLinesResult smooth_lines(Mesh& mesh, const SmoothLinesOptions& options);

}  // namespace regionmesh
