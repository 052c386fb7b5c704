// The report of smoothing, as plain data.
#pragma once

#include <cstdint>
#include <vector>

namespace regionmesh {

struct SmoothReport {
    std::uint64_t vertices = 0;
    std::uint64_t vertex_passes = 0;
    std::uint64_t turned_faces = 0;       // turned over by the filter, before backtracking
    std::uint64_t low_quality_faces = 0;  // below the bound after the filter, before backtracking
    std::uint64_t crossing_pairs = 0;     // found while intersections are resolved
    std::uint64_t islands = 0;            // separate parts found to change sides of another, likewise
    std::uint64_t held_vertices = 0;      // stopped at the farthest allowed along the sweep
    std::uint64_t backtracked = 0;        // vertices, in the end
    double largest_displacement = 0;      // length
    double rms_displacement = 0;
    std::uint32_t window_chunks = 0;  // most strips held at a time
    std::uint64_t window_bytes = 0;   // at their peak
    double filter_seconds = 0, guard_seconds = 0;
    std::vector<double> volume_before, volume_after;  // by dense label, length^3
};

}  // namespace regionmesh
