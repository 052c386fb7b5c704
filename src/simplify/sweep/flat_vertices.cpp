#include "simplify/sweep/flat_vertices.h"

#include <algorithm>

#include "judge/verdict/quality.h"
#include "judge/verdict/verdicts.h"
#include "simplify/sweep/sweep_marks.h"
#include "simplify/tuning.h"

namespace regionmesh {
namespace {

class FlatSweeps {
public:
    explicit FlatSweeps(Judge& judge) : judge_(judge), mesh_(judge.mesh()), marks_(mesh_.vertex_end()) {}

    /// Returns the number of vertices removed.
    std::uint32_t sweep() {
        marks_.begin_sweep();
        std::uint32_t removed = 0;
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
            if (!marks_.is_due(VertexId{v})) continue;
            if (may_go(VertexId{v}) && try_to_remove(VertexId{v}))
                ++removed;
            else
                marks_.settle(VertexId{v});
        }
        return removed;
    }

private:
    bool may_go(VertexId v) const {
        const Vertex& vertex = mesh_[v];
        return vertex.is_alive && !vertex.is_fixed && vertex.label_count == 2 && is_level(v);
    }

    /// Do all faces lie in one plane square to an axis?
    bool is_level(VertexId v) const {
        const Vec3 at = mesh_.position(v);
        unsigned axes = 7;
        for (Corner c = mesh_[v].star; c != kNoCorner && axes != 0; c = mesh_[FaceId{c >> 2}].next[c & 3])
            for (const VertexId corner : mesh_[FaceId{c >> 2}].vertices) {
                const Vec3 p = mesh_.position(corner);
                axes &= (p.x == at.x) | (p.y == at.y) << 1 | (p.z == at.z) << 2;
            }
        return axes != 0;
    }

    bool try_to_remove(VertexId v) {
        gather_vertex(mesh_, v, around_);
        if (around_.face_count() > kMostPrepassFaces || !is_closed()) return false;
        const VertexId target = best_target();
        if (target == kNoVertex) return false;
        EdgeStar& star = change_.star;
        gather_half(mesh_, v, target, star);
        if (topology_verdict(judge_, change_) != Verdict::kAccepted) return false;
        change_.position = star.at_stays;
        set_normals(star, star.at_stays);
        note_flat(star, star.at_stays);
        if (test_error(judge_, change_) != Verdict::kAccepted) return false;
        find_error(judge_, change_);
        judge_.apply(change_);
        marks_.touch(target);
        for (VertexId w : star.link) marks_.touch(w);
        return true;
    }

    bool is_closed() const {
        const auto& faces = around_.faces;
        return std::ranges::all_of(
            faces, [&](const StarFace& face) { return std::ranges::find(faces, face.b, &StarFace::a) != faces.end(); });
    }

    /// The neighbour that leaves the best worst face, of equal ones the first by number.
    VertexId best_target() const {
        VertexId best = kNoVertex;
        double best3 = 0;
        for (const StarFace& face : around_.faces) {  // each neighbour comes first in one face
            if (mesh_[face.a].is_fixed || marks_.is_touched(face.a)) continue;
            const double own3 = fan_quality3(mesh_, around_, face.a, mesh_.position(face.a), judge_.bounds());
            if (own3 > best3 || (own3 == best3 && own3 > 0 && face.a < best)) {
                best3 = own3;
                best = face.a;
            }
        }
        return best;
    }

    Judge& judge_;
    const Mesh& mesh_;
    Change change_;
    EdgeStar around_;  // the faces of the current vertex
    SweepMarks marks_;
};

}  // namespace

std::uint32_t remove_flat_vertices(Judge& judge, std::uint32_t target_faces) {
    FlatSweeps sweeps(judge);
    std::uint32_t removed = 0;
    sweep_above(target_faces, judge.mesh(), [&] {
        const std::uint32_t gone = sweeps.sweep();
        removed += gone;
        return gone;
    });
    return removed;
}

}  // namespace regionmesh
