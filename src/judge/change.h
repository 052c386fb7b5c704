// One proposed change of a mesh: the faces before and after it, and what its tests find.
#pragma once

#include <optional>
#include <vector>

#include "judge/edge_star.h"
#include "judge/error_bound.h"
#include "judge/labelled_triangle.h"
#include "judge/verdict/intersect_test.h"

namespace regionmesh {

/// Positions for the merged vertex; of two, the one that leaves the better worst face is taken.
struct Places {
    Vec3 first;
    std::optional<Vec3> second = {};
};

/// The change under test. Reused from one to the next, so that nothing is allocated in the long run. Every kind is a
/// star of faces round one vertex that goes to `position`: that of a collapse, a half collapse or a move is gathered in
/// `star` (gather, gather_half, gather_move); a flip is proposed with propose_flip, a split with Judge::propose_split.
struct Change {
    EdgeStar star = {};
    Vec3 position = {};             // of the merged vertex
    double worst_quality3 = 0;      // third power of the least quality of a changed face
    std::vector<FaceId> gone = {};  // faces that go although the star does not have them: of a flip or a split
    Flip flip = {};                 // where the star is of one,
    FlipBound flip_error = {};      // and its bound on the error
    IntersectTest intersect = {};
    ErrorBound error = {};

    bool is_flip() const { return star.kind == StarKind::kFlip; }
    /// Do the faces in `gone` go, rather than those of the star?
    bool replaces_others() const { return is_flip() || star.kind == StarKind::kSplit; }
};

/// Gathers the two faces that a flip makes. False where no bound on its error can be given: a face would look down.
bool propose_flip(const Mesh& mesh, const Flip& flip, Change& change);

/// The faces that the change removes, and those that it makes in their place: the regions differ between the two, and
/// nowhere else.
void list_faces_before(const Mesh& mesh, const Change& change, std::vector<LabelledTriangle>& faces);
void list_faces_after(const Mesh& mesh, const Change& change, std::vector<LabelledTriangle>& faces);

}  // namespace regionmesh
