// The invariant test of a labelled surface: violations as data, and the measures of its regions, faces and lines.
// docs/reference/check.md describes the method.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/label_oracle.h"
#include "regionmesh/mesh.h"
#include "regionmesh/shapes.h"

namespace regionmesh {

/// The kinds of violations. to_string() gives their names in reports.
enum class ViolationKind {
    kOpenEdge,            // a region has a single face at an edge (P 3.6 b)
    kOverfullEdge,        // a region has more than two faces at an edge (P 3.6 b)
    kOrientation,         // two faces of a region pass their edge in the same direction: inside and outside are mixed;
                          // or the volume of a region is negative
    kPinchedVertex,       // a region's faces at a vertex are more than one fan
    kFewEdges,            // a vertex with fewer than three edges (P 3.6 a)
    kDuplicateFace,       // two faces on the same three vertices
    kDegenerateFace,      // a face that repeats a vertex, has no finite area above 0, or one label on both sides
    kCoincidentVertices,  // two vertices at the same place (P 3.6 d)
    kUnusedVertex,        // a vertex without a face
    kCrossingFaces,       // two faces meet outside the vertices and edges that they share (exact)
    kEuler,               // the Euler characteristic of a region differs from that of its labels
    kQuadruplePoints,     // the number of interior quadruple points differs from that of the labels
    kRegionPairs,         // the number of pairs of regions with an interface differs from that of the labels
    kNesting,             // a separate part of the surface lies in the wrong region
    kNonGenericVertex,    // each region is sound, but the star is no disk, book of three pages or cone over K4
};
inline constexpr int kViolationKindCount = 15;
const char* to_string(ViolationKind kind);

/// One finding. Ids are those of the checked mesh; in a mesh without free places (Mesh::compact) they are also the
/// 0-based numbers of points and cells in the .vtp file that write_mesh makes of it.
struct Violation {
    ViolationKind kind;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> faces;
    std::string text;                // one sentence, with ids and place
    std::optional<Vec3> at = {};     // the first vertex, or the centroid of the first face; none for a whole region
    std::vector<Label> labels = {};  // that meet there, ascending
};

/// Measures of one region. Volume in length^3, positive where faces look outward; area in length^2.
struct RegionReport {
    Label label = 0;
    std::int64_t euler = 0;        // Euler characteristic of the region's boundary
    std::uint32_t components = 0;  // connected parts of the region's boundary
    double volume = 0;
    double area = 0;
};

/// Quality Q of faces (docs/explanation/decimate.md): 0.26 is equilateral, 0 degenerate. Angles in degrees.
struct QualityReport {
    double min = 0, mean = 0;
    std::array<std::uint64_t, 28> histogram{};  // bins of width 0.01 from 0
    double min_angle = 0, max_angle = 0;
    std::array<std::uint64_t, 18> angle_histogram{};  // all angles of all faces, bins of 10 degrees from 0
};

/// Measures of the lines inside the box where three or more regions meet.
struct LineReport {
    std::uint64_t edges = 0;
    double length = 0;
    double mean_turning_angle = 0;  // degrees, between consecutive edges, over the vertices inside lines
};

struct CheckOptions {
    bool boundary_is_open = false;           // the box was not capped: open edges on its sides are no violation
    std::vector<Label> background = {};      // labels without faces to the exterior; not reported as regions. Dense:
                                             // Reconstruction::background, without which faces seem to be missing
    std::optional<LabelOracle> oracle = {};  // compare with the labels of the volume
    bool crossing = true;                    // look for crossing faces
    std::uint32_t threads = 0;               // 0: one per core; the report does not depend on it
    bool is_background(Label label) const {
        return std::find(background.begin(), background.end(), label) != background.end();
    }

    /// Text of a label for sentences; called from any thread. Without it sentences give the dense label.
    std::function<std::string(Label)> label_text = {};
    std::uint32_t listed = 1000;  // largest number of findings listed of each kind; all are counted
};

struct CheckReport {
    std::array<std::uint64_t, kViolationKindCount> counts{};  // one per ViolationKind
    std::vector<Violation> violations;                        // violations, at most CheckOptions::listed of each kind
    std::vector<RegionReport> regions;                        // one per dense label; background left out
    QualityReport quality;
    std::optional<ShapeReport> shapes;  // none of a model in parts
    LineReport lines;
    std::uint64_t quadruple_points_inside = 0;
    std::uint64_t region_pairs = 0;
    std::uint64_t violation_count() const;
};

/// Checks a mesh. Never throws for what it finds. Cost: about half a microsecond per face divided by the number of
/// threads; more than half of it is the search for crossing faces.
CheckReport check(const Mesh& mesh, const CheckOptions& options = {});

/// What lock_violations() locked.
struct LockedPart {
    std::uint32_t vertices = 0;
    std::uint32_t faces = 0;  // faces with three locked vertices
};

/// Locks the vertices whose stars are not generic, and the corners of faces that are degenerate or cross others, so
/// that the rest of the mesh can be simplified and smoothed. Neither then adds a violation: each certificate is about a
/// star that is generic before and after, and locked faces take part in tests like any others. Uses the options about
/// the boundary, and threads.
LockedPart lock_violations(Mesh& mesh, const CheckOptions& options);

}  // namespace regionmesh
