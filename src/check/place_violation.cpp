// The position of a violation and the labels that meet there.
#include <algorithm>
#include <charconv>

#include "base/box.h"
#include "check/check_steps.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

/// The shortest text that reads back as the same number.
std::string text_of(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// Faces: the centroid of the first; two that cross: the middle of the common part of their boxes.
Vec3 place_of(const Mesh& mesh, const Violation& violation) {
    const auto p = mesh.corners(FaceId{violation.faces.front()});
    if (violation.kind != ViolationKind::kCrossingFaces) return p[0] / 3 + p[1] / 3 + p[2] / 3;
    const Box both = common(box_of(p), box_of(mesh.corners(FaceId{violation.faces.back()})));
    return (both.low + both.high) / 2;
}

}  // namespace

void place_violation(Vec3 at, const LabelSet& met, Violation& violation) {
    violation.at = at;
    violation.labels.assign(met.begin(), met.end());
    std::sort(violation.labels.begin(), violation.labels.end());
    violation.text += " at (" + text_of(at.x) + ", " + text_of(at.y) + ", " + text_of(at.z) + ")";
}

void place_violation(const Mesh& mesh, Violation& violation) {
    const auto& vertices = violation.vertices;
    const auto& faces = violation.faces;
    const ViolationKind kind = violation.kind;
    LabelSet met;
    if (!vertices.empty()) {
        const bool is_edge = kind == ViolationKind::kOpenEdge || kind == ViolationKind::kOverfullEdge ||
                             kind == ViolationKind::kOrientation;
        met = is_edge ? edge_labels(mesh, VertexId{vertices[0]}, VertexId{vertices[1]})
                      : vertex_labels(mesh, VertexId{vertices[0]});
        place_violation(mesh.position(VertexId{vertices[0]}), met, violation);
    } else if (!faces.empty()) {
        for (std::uint32_t f : faces)
            for (Label label : mesh[FaceId{f}].labels) met.add(label);
        place_violation(place_of(mesh, violation), met, violation);
    }
}

}  // namespace regionmesh
