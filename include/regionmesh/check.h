// The invariant test of a labelled surface: what is wrong with it, as data, and what it measures (DESIGN: check).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/label_oracle.h"
#include "regionmesh/lines.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// What can be wrong. The names are those of the report.
enum class ViolationKind {
    kOpenEdge,            // a region has a single face at an edge (P 3.6 b)
    kOverfullEdge,        // a region has more than two faces at an edge (P 3.6 b)
    kOrientation,         // two faces of a region pass their edge in the same direction: inside and outside are mixed
    kPinchedVertex,       // a region's faces at a vertex are more than one fan
    kFewEdges,            // a vertex with fewer than three edges (P 3.6 a)
    kDuplicateFace,       // two faces on the same three vertices
    kDegenerateFace,      // a face that repeats a vertex, or without area, or with one label on both sides
    kCoincidentVertices,  // two vertices at one place (P 3.6 d)
    kUnusedVertex,        // a vertex without a face
    kCrossingFaces,       // two faces meet outside what they share (exact)
    kEuler,               // the Euler characteristic of a region is not that of its labels
    kQuadruplePoints,     // interior quadruple points are not those of the labels
    kRegionPairs,         // pairs of regions with an interface are not those of the labels
    kNesting,             // a separate part of the surface lies in the wrong region
    kNonGenericVertex,    // each region is sound, but the star is no disk, book of three pages or cone over K4
};
inline constexpr int kViolationKindCount = 15;
const char* to_string(ViolationKind kind);

/// One finding: the things concerned (ids of the model checked), a sentence, and where it is: the place of the first
/// vertex, or the middle of the first face, and the labels that meet there. What is said of a whole region has no
/// place.
struct Violation {
    ViolationKind kind;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> faces;
    std::string text;
    std::optional<Vec3> at = {};
    std::vector<Label> labels = {};
};

/// Per-region measures; volume in length^3 with the sign that outward faces give, area in length^2.
struct RegionReport {
    Label label = 0;
    std::int64_t euler = 0;
    std::uint32_t components = 0;  // of the region's boundary surface
    double volume = 0;
    double area = 0;
};

/// Quality Q of faces (see model/geometry.h): 0.26 at best. Angles in degrees.
struct QualityReport {
    double min = 0, mean = 0;
    std::array<std::uint64_t, 28> histogram{};  // bins of width 0.01 from 0
    double min_angle = 0, max_angle = 0;
    std::array<std::uint64_t, 18> angle_histogram{};  // all angles of all faces, bins of 10 degrees from 0
};

struct CheckOptions {
    bool boundary_is_open = false;           // the box was not capped: open edges on it are no violation
    std::vector<Label> background = {};      // these labels have no faces with the exterior: not reported as regions
    std::optional<LabelOracle> oracle = {};  // compare with the labels
    bool crossing = true;                    // look for crossing faces
    std::uint32_t threads = 0;               // at work; 0: one per core. The report is the same for any number
    bool is_background(Label label) const {
        return std::find(background.begin(), background.end(), label) != background.end();
    }

    /// For sentences, from any thread; the dense number without it.
    std::function<std::string(Label)> label_text = {};
    std::uint32_t listed = 1000;  // at most so many findings a kind are listed; all are counted
};

struct CheckReport {
    std::array<std::uint64_t, kViolationKindCount> counts{};
    std::vector<Violation> violations;  // at most CheckOptions::listed a kind
    std::vector<RegionReport> regions;  // by dense label; background left out
    QualityReport quality;
    LineReport lines;
    std::uint64_t quadruple_points_inside = 0;
    std::uint64_t region_pairs = 0;
    std::uint64_t violation_count() const;
};

/// Checks a model; never throws for what it finds. Cost: half a microsecond a face over the threads at work, more than
/// half of it for crossing.
CheckReport check(const Mesh& mesh, const CheckOptions& options = {});

}  // namespace regionmesh
