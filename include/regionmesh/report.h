// What a run did and made, as plain data. report_json() in regionmesh/write_report.h writes it as JSON.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/check.h"
#include "regionmesh/denoise.h"
#include "regionmesh/improve.h"
#include "regionmesh/remesh.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "regionmesh/smooth_lines.h"
#include "regionmesh/voxelise.h"

namespace regionmesh {

struct Report {
    std::uint64_t initial_faces = 0;  // before simplification, whether or not they ever existed at once
    std::uint64_t initial_vertices = 0;
    std::uint64_t final_faces = 0;
    std::uint64_t final_vertices = 0;
    std::map<std::string, double> seconds;             // by stage, and "total"
    std::map<std::string, std::uint64_t> stage_bytes;  // by stage: largest resident size of the process seen in it
    std::uint64_t peak_bytes = 0;                      // largest resident size of the process
    std::uint64_t peak_faces = 0;                      // most faces held at once
    double bytes_per_face = 0;                         // of mesh and decimation at their peak, over the faces held then
    SmoothReport smoothing;
    std::vector<double> unsmoothed_volumes;  // by dense label, length^3; empty if not needed
    PreserveReport preserved;
    std::uint64_t pinned_vertices = 0;  // where tetrahedra touch themselves: not moved, not collapsed
    VerdictCounts verdicts{};
    std::uint64_t refreshes = 0;
    StopReason stopped = StopReason::kNoneAsked;
    std::optional<double> quality_bound;   // of faces that decimation changes, with z scaled; none without decimation
    std::optional<FloorResult> floor;      // what was done about faces below that; none without decimation
    std::optional<RemeshResult> remeshed;  // where ReconstructOptions::edge_length asked for it
    std::optional<SmoothLinesResult> smoothed_lines;  // where ReconstructOptions::smooth_lines asked for it
    std::optional<ImproveResult> improved;            // where ReconstructOptions::improve asked for it
    double error_bound = 0;  // no point of the surface before or after decimation is farther from the other
    CheckReport check;
    DenoiseReport denoise;                   // what ReconstructOptions::denoise found and changed
    std::uint32_t sections_between = 0;      // put between each two of the input, before anything else
    std::uint32_t sections_moved = 0;        // in their plane, by PrepareOptions::align
    double largest_section_shift = 0;        // of those, in samples
    Overlaps overlaps = {};                  // of the masks that the input consists of
    std::uint64_t samples_in_room = 0;       // changed by ReconstructOptions::room, before anything else
    std::optional<SampleAgreement> samples;  // of sections; none where they cannot be read again, or the box is open
};

}  // namespace regionmesh
