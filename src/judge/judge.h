// The only writer of a mesh: makes the changes that the tests accept.
#pragma once

#include <optional>

#include "base/box.h"
#include "judge/change.h"
#include "judge/collapse_log.h"
#include "judge/verdict/rising_faces.h"
#include "judge/verdict/shape_bounds.h"
#include "mesh/face_tree.h"
#include "regionmesh/promises.h"

namespace regionmesh {

/// The box that holds everything.
inline constexpr Box kUnbounded{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};

/// How a judge looks at its mesh.
struct JudgeOptions {
    Box limits = kUnbounded;      // merged vertices that move stay strictly inside, unless on a side of the box
    bool sees_others = true;      // false: tests of the star alone follow (flat_vertices.h), and no tree is made
    bool bounds_regions = false;  // asserts that each face has its first label behind it and its second in front of
                                  // it, everywhere; changes are then tested faster, with the same result
    FaceTree::Faces faces = FaceTree::Faces::kOneByOne;
    CollapseLog* log = nullptr;  // filled with the collapses made
    std::uint32_t threads = 1;   // at work at a time when trees are made; 0: one per core. The result is the same
};

/// Holds the promises, and what the tests in judge/verdict need to know of the whole mesh. Stages propose a Change,
/// several threads at a time if they like, each with a Change of its own (examine, verdict_at in verdicts.h); one
/// thread then applies those that were accepted. Nobody else moves vertices of the mesh or makes or removes faces
/// meanwhile.
class Judge {
public:
    /// Keeps references to both.
    Judge(Mesh& mesh, const Promises& promises, const JudgeOptions& options = {});
    Judge(const Judge&) = delete;
    Judge& operator=(const Judge&) = delete;

    const Mesh& mesh() const { return mesh_; }
    const Promises& promises() const { return promises_; }
    const ShapeBounds& bounds() const { return bounds_; }
    const Box& limits() const { return limits_; }
    /// Of the faces; null: they may meet.
    const FaceTree* tree() const { return tree_ ? &*tree_ : nullptr; }
    /// Of the same faces, where they bound regions; else null.
    const RisingFaces* rising() const { return rising_ ? &*rising_ : nullptr; }

    /// Gathers the split of the edge u-v by a new vertex, which is made in its middle without faces: star.goes. Where
    /// the change is not applied, withdraw it. A face in the star counts for `quality` as it would be with the vertex
    /// there.
    void propose_split(VertexId u, VertexId v, Change& change);
    void withdraw(const Change& split);
    /// Makes the change, which the tests accepted on the mesh as it is now. Flips and splits get the ids of the new
    /// faces.
    void apply(Change& change);
    /// Packs the faces and renumbers them.
    void pack(std::uint32_t threads);
    CollapseLog* log() const { return log_; }
    /// In addition to the mesh.
    std::size_t bytes() const { return (tree_ ? tree_->bytes() : 0) + (rising_ ? rising_->bytes() : 0); }

private:
    void collapse(const Change& change);
    void move(const Change& change);
    void flip(Change& change);
    void split(Change& change);
    void remove(FaceId f);
    void make_room();
    void note_star(const EdgeStar& star, Vec3 position);

    Mesh& mesh_;
    const Promises& promises_;
    ShapeBounds bounds_;
    Box limits_;
    CollapseLog* log_;
    std::optional<FaceTree> tree_;
    std::optional<RisingFaces> rising_;
    std::uint32_t known_faces_ = 0;  // faces that both have room for
    std::uint32_t threads_;
};

}  // namespace regionmesh
