// Finds the faces on a straight line from a point to the outside, exactly.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesh/sorted_face_tree.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A face that the line passes. Does the line leave the face's first label there and enter its second?
struct FacePassed {
    FaceId face;
    bool leaves_first;
};

/// Lines that pass through the interior of faces, never through an edge or a vertex: all signs are exact, and if one is
/// zero another line is tried.
class ExactRay {
public:
    /// Holds references. `tree` contains all faces of the mesh.
    ExactRay(const Mesh& mesh, const SortedFaceTree& tree);

    /// All wanted faces on a line from `from` to a point beyond the whole mesh, unordered. nullopt if `from` lies on a
    /// wanted face, or in the planes of so many of them that every line tried meets an edge.
    std::optional<std::vector<FacePassed>> faces_passed(Vec3 from, const std::function<bool(FaceId)>& is_wanted) const;

private:
    std::optional<std::vector<FacePassed>> faces_between(Vec3 from, Vec3 to,
                                                         const std::function<bool(FaceId)>& is_wanted) const;

    const Mesh& mesh_;
    const SortedFaceTree& tree_;
    Box extent_;
};

}  // namespace regionmesh
