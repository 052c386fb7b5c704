// Collects violations: counts all and lists the first of each kind.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "check/lines.h"
#include "mesh/label_set.h"
#include "mesh/mesh_part.h"
#include "mesh/sorted_face_tree.h"
#include "mesh/star_crossing.h"
#include "regionmesh/check.h"

namespace regionmesh {

struct PartStars;

/// Sums over all stars.
struct StarTotals {
    std::vector<RegionReport> regions;  // by dense label
    std::uint64_t quadruple_points_inside = 0;
    LineTotals lines;
    std::vector<FacePair> crossings;  // of faces that share a vertex
};

/// Each part of the work collects its own; they are appended in an order that does not depend on the threads.
class Findings {
public:
    explicit Findings(std::uint32_t listed = 0) : listed_(listed) {}

    /// text() makes the sentence; called only if the finding is listed. Returns it then, until the next is added.
    template <class Text>
    Violation* add(ViolationKind kind, std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces,
                   Text&& text) {
        if (counts_[static_cast<int>(kind)]++ >= listed_) return nullptr;
        return &violations_.emplace_back(Violation{kind, std::move(vertices), std::move(faces), text(), {}, {}});
    }

    void append(Findings&& later) {
        std::array<std::uint64_t, kViolationKindCount> listed = counts_;
        for (Violation& violation : later.violations_)
            if (listed[static_cast<int>(violation.kind)]++ < listed_) violations_.push_back(std::move(violation));
        for (int kind = 0; kind < kViolationKindCount; ++kind) counts_[kind] += later.counts_[kind];
    }

    std::uint64_t count(ViolationKind kind) const { return counts_[static_cast<int>(kind)]; }

    /// The findings of a report, before anything else.
    void take_from(CheckReport&& report) {
        counts_ = report.counts;
        violations_ = std::move(report.violations);
    }

    void move_to(CheckReport& report) {
        report.counts = counts_;
        report.violations = std::move(violations_);
    }

private:
    std::uint32_t listed_;
    std::array<std::uint64_t, kViolationKindCount> counts_{};
    std::vector<Violation> violations_;
};

/// Faces or vertices per task.
inline constexpr std::uint32_t kCheckChunk = 1 << 14;

/// Is the face ignored by its neighbours because it repeats a vertex?
inline bool repeats_a_vertex(const Face& face) {
    const auto& v = face.vertices;
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

inline std::string name(VertexId v) { return "vertex " + std::to_string(index(v)); }
inline std::string name(FaceId f) { return "face " + std::to_string(index(f)); }
inline std::string name(VertexId u, VertexId v) {
    return "edge " + std::to_string(index(u)) + "-" + std::to_string(index(v));
}
/// "region 17", with the label of the input if label_text is set.
inline std::string region_name(const CheckOptions& options, Label label) {
    if (is_exterior(label)) return "the exterior";
    return "region " + (options.label_text ? options.label_text(label) : std::to_string(label) + " (dense)");
}

/// The parts of check(). Each reads the mesh, or what belongs to a part of it, and adds its findings. `regions` is by
/// dense label.
void check_faces(const Mesh& mesh, const CheckOptions& options, std::vector<RegionReport>& regions, CheckReport& report,
                 Findings& findings);
void check_stars(const Mesh& mesh, const CheckOptions& options, StarTotals& totals, Findings& findings,
                 const PartStars* part = nullptr);
void check_places(const Mesh& mesh, const CheckOptions& options, Findings& findings, const MeshPart* part = nullptr);
/// `in_stars` are the crossings of faces that share a vertex.
void check_crossing(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree& tree,
                    std::vector<FacePair> in_stars, Findings& findings, const MeshPart* part = nullptr);
/// `tree` may be null; the function then builds one if it needs it.
void check_nesting(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree* tree, Findings& findings);
/// Lists the regions that have faces, without the background.
void list_regions(const CheckOptions& options, const std::vector<RegionReport>& regions, CheckReport& report);
void check_against_labels(const CheckOptions& options, CheckReport& report, Findings& findings);
/// Finds regions that are inside out. `sums` are by dense label, the background included. If the surface is open
/// somewhere, or its orientation mixed, volumes mean nothing, and nothing is added.
void check_volumes(const CheckOptions& options, const std::vector<RegionReport>& sums, const CheckReport& report,
                   Findings& findings);

/// Adds the place and the labels of a violation, and appends the place to its sentence.
void place_violation(const Mesh& mesh, Violation& violation);
void place_violation(Vec3 at, const LabelSet& met, Violation& violation);

}  // namespace regionmesh
