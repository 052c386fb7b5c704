// What smoothing did, as plain data.
#pragma once

#include <cstdint>
#include <vector>

namespace regionmesh {

struct SmoothReport {
    std::uint64_t vertices = 0;
    std::uint64_t vertex_passes = 0;
    std::uint64_t turned_faces = 0;       // turned over by the filter, before vertices stepped back
    std::uint64_t low_quality_faces = 0;  // fallen below the bound by the filter, before vertices stepped back
    std::uint64_t crossing_pairs = 0;     // found crossing on the way
    std::uint64_t islands = 0;            // separate parts found to change sides of another on the way
    std::uint64_t held_vertices = 0;      // that would have gone too far along the sweep
    std::uint64_t backtracked = 0;        // vertices that did in the end
    double largest_displacement = 0;      // length
    double rms_displacement = 0;
    std::uint32_t window_chunks = 0;  // most strips held at once
    std::uint64_t window_bytes = 0;   // at most
    double filter_seconds = 0, guard_seconds = 0;
    std::vector<double> volume_before, volume_after;  // by dense label, length^3
};

}  // namespace regionmesh
