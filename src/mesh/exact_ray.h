// Which faces does a straight line from a point to the outside pass, exactly?
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesh/sorted_face_tree.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A face passed, and whether the line leaves its first label there (and enters its second).
struct FacePassed {
    FaceId face;
    bool leaves_first;
};

/// Lines that pass faces inside them, never through an edge or a vertex: all signs are exact, and a line with a sign of
/// zero is given up for another one.
class ExactRay {
public:
    /// Holds both; the tree is over all faces of the model.
    ExactRay(const Mesh& mesh, const SortedFaceTree& tree);

    /// All wanted faces on a line from `from` to a point beyond the whole model, in no order. Nothing where `from` lies
    /// on a wanted face (or, for points nobody would choose, on the continuation of too many of them).
    std::optional<std::vector<FacePassed>> faces_passed(Vec3 from, const std::function<bool(FaceId)>& is_wanted) const;

private:
    std::optional<std::vector<FacePassed>> faces_between(Vec3 from, Vec3 to,
                                                         const std::function<bool(FaceId)>& is_wanted) const;

    const Mesh& mesh_;
    const SortedFaceTree& tree_;
    Box extent_;
};

}  // namespace regionmesh
