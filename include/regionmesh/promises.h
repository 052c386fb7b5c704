// What every change of a mesh keeps, and why a change is refused.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "regionmesh/lattice.h"

namespace regionmesh {

/// Lowest quality of a changed face where none is given.
inline constexpr double kUsualQuality = 0.1;

/// What a change of a mesh must keep, the same for all stages that change one: decimation, smooth lines, improvement,
/// blocks. Topology is always kept. A new promise is a field here, a name in Verdict, and a row with its test in
/// src/judge/verdict (CONTRIBUTING.md).
struct Promises {
    std::optional<double> min_quality = {};  // lowest quality of a changed face; 0: no bound; none: kUsualQuality. A
                                             // star that comes with faces below may keep as many
    double max_error = HUGE_VAL;             // largest distance of any point from the surface as it came, and of any
                                             // point of that one from the surface, a length
    bool intersect_check = true;             // no face meets another one
    std::optional<Lattice> samples = {};     // lattice whose samples stay in their regions, and whose box holds all
                                             // merged vertices; along the axes of coordinates (BoxAxes::samples)
    std::optional<Box> box = {};  // box that holds all merged vertices, for models without faces on its sides
    double scale = 1;             // length of a typical edge: the sample spacing, or typical_edge(mesh)
    double scale_z = 1;           // factor of z of the mesh; angles are reported without it

    double quality_bound() const { return min_quality.value_or(kUsualQuality); }
};

/// Throws Error(kUsage) for numbers out of range, an empty box, and oblique samples (box_axes.h); Error(kInput) for
/// samples that are no lattice.
void require_in_range(const Promises& promises);

/// The bound on quality where none is given: kUsualQuality for cubes of samples, and less where `spacing` stretches
/// them. A face of that quality keeps this at least when its lattice of cubes is stretched.
double usual_quality_bound(const Vec3& spacing);

/// Result of the tests of a change, in their order, cheap ones first; a change is refused with the first that fails
/// (docs/explanation/decimate.md).
enum class Verdict { kAccepted, kStrata, kLink, kFold, kQuality, kPinch, kError, kSamples, kIntersect };

inline constexpr std::array kVerdictNames{"accepted", "strata", "link",    "fold",     "quality",
                                          "pinch",    "error",  "samples", "intersect"};
inline constexpr int kVerdictCount = static_cast<int>(kVerdictNames.size());

/// Number of changes by verdict.
using VerdictCounts = std::array<std::uint64_t, kVerdictCount>;

inline void add(VerdictCounts& counts, const VerdictCounts& more) {
    for (std::size_t n = 0; n < counts.size(); ++n) counts[n] += more[n];
}

/// Why decimation ended; kNoneAsked where there was none.
enum class StopReason { kTarget, kMaxError, kTopology, kNoneAsked };

/// As reports have it: "target", "max_error", "topology", "none asked".
constexpr const char* to_string(StopReason reason) {
    switch (reason) {
        case StopReason::kTarget:
            return "target";
        case StopReason::kMaxError:
            return "max_error";
        case StopReason::kTopology:
            return "topology";
        case StopReason::kNoneAsked:
            break;
    }
    return "none asked";
}

}  // namespace regionmesh
