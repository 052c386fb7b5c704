// Smoother lines between three regions, on the finished surface.
#pragma once

#include <cstdint>
#include <functional>

#include "regionmesh/mesh.h"
#include "regionmesh/promises.h"

namespace regionmesh {

struct SmoothLinesOptions {
    Promises promises = {};     // no vertex moves farther than its scale; max_error limits the error_bound below
    std::uint32_t sweeps = 8;   // most sweeps over all vertices of lines
    std::uint32_t threads = 0;  // at work at a time; 0: one per core. The result is the same
    std::function<void()> on_progress = {};  // called now and then, on the calling thread
};

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
/// bending energy, and of a small share of its squared distance from where it was (docs/explanation/smoothing.md). Each
/// step keeps the promises: no violation is added, strata stay, and vertices stay on their sides of the box; those on
/// its edges do not move. Deterministic. Requires that every vertex that is not fixed has all its faces in the mesh.
/// Throws like simplify().
SmoothLinesResult smooth_lines(Mesh& mesh, const SmoothLinesOptions& options);

}  // namespace regionmesh
