// Collects violations: counts all, lists some.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesh/sorted_face_tree.h"
#include "regionmesh/check.h"

namespace regionmesh {

/// Each part of the work collects its own; they are appended in an order that the threads do not change.
class Findings {
public:
    explicit Findings(std::uint32_t listed = 0) : listed_(listed) {}

    /// text() is the sentence; it is asked for only where the finding is listed.
    template <class Text>
    void add(ViolationKind kind, std::vector<std::uint32_t> vertices, std::vector<std::uint32_t> faces, Text&& text) {
        if (counts_[static_cast<int>(kind)]++ < listed_)
            violations_.push_back({kind, std::move(vertices), std::move(faces), text(), {}, {}});
    }

    void append(Findings&& later) {
        std::array<std::uint64_t, kViolationKindCount> listed = counts_;
        for (Violation& violation : later.violations_)
            if (listed[static_cast<int>(violation.kind)]++ < listed_) violations_.push_back(std::move(violation));
        for (int kind = 0; kind < kViolationKindCount; ++kind) counts_[kind] += later.counts_[kind];
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

/// Faces or vertices that are looked at together; nothing else depends on how many.
inline constexpr std::uint32_t kCheckChunk = 1 << 14;

/// Such a face is no face to its neighbours.
inline bool repeats_a_vertex(const Face& face) {
    const auto& v = face.vertices;
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

inline std::string name(VertexId v) { return "vertex " + std::to_string(index(v)); }
inline std::string name(FaceId f) { return "face " + std::to_string(index(f)); }
inline std::string name(VertexId u, VertexId v) {
    return "edge " + std::to_string(index(u)) + "-" + std::to_string(index(v));
}
/// "region 17", in the words of the input where they are known.
inline std::string region_name(const CheckOptions& options, Label label) {
    if (is_exterior(label)) return "the exterior";
    return "region " + (options.label_text ? options.label_text(label) : std::to_string(label) + " (dense)");
}

/// The parts of check(); each reads the model and adds what it finds. `regions` is by dense label.
void check_faces(const Mesh& mesh, const CheckOptions& options, std::vector<RegionReport>& regions, CheckReport& report,
                 Findings& findings);
void check_stars(const Mesh& mesh, const CheckOptions& options, std::vector<RegionReport>& regions, CheckReport& report,
                 Findings& findings);
void check_places(const Mesh& mesh, const CheckOptions& options, Findings& findings);
void check_crossing(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree& tree, Findings& findings);
/// The tree may be missing: one is made where it is needed.
void check_nesting(const Mesh& mesh, const CheckOptions& options, const SortedFaceTree* tree, Findings& findings);
void check_against_labels(const CheckOptions& options, CheckReport& report, Findings& findings);
/// Says where the violation is, in its sentence, too.
void place_violation(const Mesh& mesh, Violation& violation);

}  // namespace regionmesh
