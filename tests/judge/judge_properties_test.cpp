// What holds of whatever the judge accepts, on volumes and changes drawn at random.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <vector>

#include "judge/judge.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "regionmesh/voxelise.h"
#include "support/runs.h"
#include "support/volumes_drawn.h"

namespace regionmesh {
namespace {

/// A change that is tried: an edge by the number of a corner, and how far the merged vertex lies along it.
struct DrawnChange {
    std::uint32_t corner;
    double along;
    bool is_move;  // of the first end, rather than a collapse
};

rc::Gen<DrawnChange> drawn_change() {
    return rc::gen::construct<DrawnChange>(rc::gen::inRange<std::uint32_t>(0, 1 << 20),
                                           rc::gen::element(0.0, 0.1, 0.3, 0.5, 0.9, 1.0), rc::gen::arbitrary<bool>());
}

void showValue(const DrawnChange& change, std::ostream& out) {
    out << (change.is_move ? "move " : "collapse ") << change.corner << " by " << change.along;
}

/// Makes the change if the judge accepts it.
bool try_to_make(Judge& judge, const DrawnChange& drawn) {
    const Mesh& mesh = judge.mesh();
    const FaceId f{drawn.corner / 3 % mesh.face_end()};
    if (!mesh.is_alive(f)) return false;
    const VertexId goes = mesh[f].vertices[drawn.corner % 3], stays = mesh[f].vertices[(drawn.corner + 1) % 3];
    Change change;
    const Vec3 from = mesh.position(goes), to = mesh.position(stays);
    if (drawn.is_move) {
        if (mesh[goes].label_count > 2 || mesh[goes].sides != 0) return false;  // moved by the stages along lines only
        gather_move(mesh, goes, change.star);
    } else {
        gather(mesh, goes, stays, change.star);
    }
    const Verdict verdict = examine(judge, change, [&] { return Places{from + drawn.along * (to - from)}; });
    if (verdict != Verdict::kAccepted) return false;
    judge.apply(change);
    return true;
}

/// The model of a volume after all changes that the judge accepts.
void require_promises_kept(test::ArrayVolume volume, const std::vector<DrawnChange>& changes) {
    Reconstruction made = test::run(volume);
    LabelOracle oracle;
    {
        volume.rewind();
        oracle = relabelled(count_labels(volume, {.background = {}, .cells = CellKind::kTetrahedra}).oracle,
                            made.labels, made.labels);
    }
    Promises promises;
    promises.samples = volume.info().lattice;
    count_labels(made.mesh);
    std::uint32_t done = 0;
    {
        Judge judge(made.mesh, promises, {.bounds_regions = true});
        for (const DrawnChange& change : changes) done += try_to_make(judge, change);
    }
    RC_TAG(done > 0 ? "changed" : "as it was");
    made.mesh.compact();
    const CheckReport report = check(made.mesh, {.oracle = oracle});
    for (const Violation& violation : report.violations) RC_LOG() << violation.text << "\n";
    RC_ASSERT(report.violation_count() == 0u);
    volume.rewind();
    RC_ASSERT(compare_samples(made.mesh, made.labels, {}, volume, 1).wrong == 0u);
}

RC_GTEST_PROP(JudgeProperties, what_is_accepted_keeps_topology_crossings_and_samples, ()) {
    const auto volume = *test::drawn_volume(4);
    const auto changes = *rc::gen::resize(300, rc::gen::container<std::vector<DrawnChange>>(drawn_change()));
    require_promises_kept(volume, changes);
}

RC_GTEST_PROP(JudgeProperties, faces_before_and_after_bound_the_same_regions_elsewhere, ()) {
    const auto volume = *test::drawn_volume(4);
    const auto changes = *rc::gen::container<std::vector<DrawnChange>>(drawn_change());
    test::ArrayVolume own = volume;
    Reconstruction made = test::run(own);
    const std::uint64_t faces = made.mesh.face_count();
    Promises promises;
    promises.samples = own.info().lattice;
    count_labels(made.mesh);
    Judge judge(made.mesh, promises);
    std::uint64_t gone = 0;
    for (const DrawnChange& drawn : changes) {
        const std::uint64_t before = judge.mesh().face_count();
        const bool is_made = try_to_make(judge, drawn);
        const std::uint64_t less = before - judge.mesh().face_count();
        // A collapse takes the faces at its edge out, at least two; a move none.
        const bool is_right = is_made && !drawn.is_move ? less >= 2 : less == 0;
        RC_ASSERT(is_right);
        gone += less;
    }
    RC_ASSERT(judge.mesh().face_count() == faces - gone);
}

}  // namespace
}  // namespace regionmesh
