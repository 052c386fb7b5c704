#include "simplify/sweep/prepass.h"

#include <gtest/gtest.h>

#include <set>

#include "base/triangle.h"
#include "mesh/strata.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

struct Swept {
    VerdictCounts verdicts{};
    std::uint32_t removed = 0;
};

/// Calls work(prepass) with all that a prepass needs.
template <class Work>
void with_prepass(Mesh& mesh, double max_cost, const SimplifyOptions& options, Work&& work) {
    count_labels(mesh);
    const std::unique_ptr<Placement> placement = make_placement(mesh, options);
    Judge judge(mesh, options.promises);
    Prepass prepass(judge, *placement, options, max_cost);
    work(prepass);
}

Swept sweep(Mesh& mesh, int sweeps, double max_cost = 1e-3, const SimplifyOptions& options = {}) {
    Swept done;
    with_prepass(mesh, max_cost, options, [&](Prepass& prepass) {
        for (int n = 0; n < sweeps; ++n) done.removed += prepass.sweep(done.verdicts);
    });
    return done;
}

Mesh smoothed(test::ArrayVolume volume) {
    ReconstructOptions options = test::plain();
    options.smooth = {.filter = SmoothFilter::kLattice, .passes = 20};
    return run(volume, options).mesh;
}
Mesh many_grains() { return run(test::grain_volume({14, 14, 14}, 9, 5)).mesh; }
Mesh ball() { return run(test::ball_volume({16, 16, 16}, 6)).mesh; }

TEST(Prepass, takes_most_of_what_is_flat) {
    Mesh mesh = run(test::solid_volume({12, 12, 12})).mesh;
    const std::uint32_t before = mesh.face_count();
    const Swept done = sweep(mesh, 12);
    EXPECT_LT(mesh.face_count(), before / 4);
    EXPECT_EQ(before - mesh.face_count(), 2 * done.removed);
    EXPECT_EQ(done.verdicts[static_cast<int>(Verdict::kAccepted)], done.removed);
    test::expect_sound(check(mesh));
}

TEST(Prepass, keeps_all_strata_and_meets_nothing) {
    for (auto* make : {many_grains, ball}) {
        Mesh mesh = make();
        const test::StrataList strata = test::list_strata(mesh);
        EXPECT_GT(sweep(mesh, 8, 1).removed, 0u);
        test::expect_same_strata(test::list_strata(mesh), strata);
        test::expect_sound(check(mesh));
    }
}

TEST(Prepass, holds_tangled_surfaces_apart) {
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        Mesh mesh = run(test::noise_volume({9, 9, 9}, 4, seed)).mesh;
        sweep(mesh, 8, 10, {.promises = {.min_quality = 0}});
        test::expect_sound(check(mesh));
    }
}

TEST(Prepass, without_the_intersection_test_still_keeps_faces_from_closing) {
    Mesh mesh = many_grains();
    const Swept done = sweep(mesh, 8, 1, {.promises = {.intersect_check = false}});
    EXPECT_GT(done.removed, 0u);
    EXPECT_EQ(done.verdicts[static_cast<int>(Verdict::kIntersect)], 0u);
    for (const Violation& violation : check(mesh).violations) EXPECT_EQ(violation.kind, ViolationKind::kCrossingFaces);
}

TEST(Prepass, moves_no_vertex) {
    Mesh mesh = ball();
    std::vector<Vec3> before;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) before.push_back(mesh.position(VertexId{v}));
    sweep(mesh, 4);
    test::for_vertices(mesh, [&](VertexId v) { EXPECT_EQ(mesh.position(v), before[index(v)]); });
}

TEST(Prepass, leaves_fixed_vertices_alone) {
    Mesh mesh = ball();
    std::uint32_t fixed = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 3, ++fixed) mesh[VertexId{v}].is_fixed = true;
    const std::uint32_t before = mesh.vertex_count();
    const Swept done = sweep(mesh, 12);
    EXPECT_GT(done.removed, 0u);
    EXPECT_LE(done.removed, before - fixed);
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 3) EXPECT_TRUE(mesh.is_alive(VertexId{v}));
    test::expect_sound(check(mesh));
}

TEST(Prepass, costs_no_more_than_the_threshold) {
    Mesh none = ball();
    const std::uint32_t before = none.face_count();
    sweep(none, 4, -1);
    EXPECT_EQ(none.face_count(), before);
    Mesh cheap = ball(), dear = ball();
    sweep(cheap, 8, 1e-4);
    sweep(dear, 8, 1e-1);
    EXPECT_GT(cheap.face_count(), dear.face_count());
    Mesh exact = ball();
    sweep(exact, 8, 1, {.promises = {.max_error = 0}});
    EXPECT_GE(exact.face_count(), cheap.face_count()) << "no more than what costs nothing";
}

TEST(Prepass, depends_on_the_model_alone) {
    Mesh first = many_grains(), second = many_grains();
    sweep(first, 5);
    sweep(second, 5);
    EXPECT_EQ(test::digest(first), test::digest(second));
}

TEST(Prepass, a_sweep_touches_no_star_twice) {
    Mesh mesh = run(test::solid_volume({12, 12, 12})).mesh;
    const std::uint32_t before = mesh.vertex_count();
    EXPECT_LT(sweep(mesh, 1, 1e-3).removed, before / 3);
}

std::uint32_t faces_below(const Mesh& mesh, double quality) {
    std::uint32_t count = 0;
    test::for_faces(mesh, [&](FaceId f) {
        const auto [a, b, c] = mesh.corners(f);
        count += face_quality(a, b, c) < quality;
    });
    return count;
}

TEST(Prepass, removes_slivers_and_tries_no_vertex_twice_in_vain) {
    constexpr std::uint32_t kInOrder = 0;
    std::set<std::uint64_t> in_stripes;
    for (const std::uint32_t threads : {kInOrder, 1u, 2u, 5u}) {
        Mesh mesh = smoothed(test::noise_volume({14, 14, 14}, 3, 6));
        constexpr double kBound = 0.1;
        const std::uint32_t before = faces_below(mesh, kBound);
        with_prepass(mesh, 1e-2, {.promises = {.min_quality = kBound}}, [&](Prepass& prepass) {
            prepass.find(Prepass::Fault::kSliver, 2);
            VerdictCounts verdicts{};
            const auto remove = [&] {
                return prepass.remove(Prepass::Fault::kSliver, verdicts, threads != kInOrder, threads);
            };
            std::uint32_t removed = 0;
            while (const std::uint32_t now = remove()) removed += now;
            EXPECT_GT(removed, 0u);
            EXPECT_LT(faces_below(mesh, kBound), before);
            const VerdictCounts tried = verdicts;
            EXPECT_EQ(remove(), 0u);
            EXPECT_EQ(verdicts, tried);
            EXPECT_GT(faces_below(mesh, kBound), 0u) << "nothing was left to try";
        });
        test::expect_sound(check(mesh));
        if (threads != kInOrder) in_stripes.insert(test::digest(mesh));
    }
    EXPECT_EQ(in_stripes.size(), 1u);
}

/// Edges of two faces of one interface that make less than a right angle, beside lines.
int folds_of(const Mesh& mesh) {
    const auto normal_of = [&](FaceId f) {
        const auto [a, b, c] = mesh.corners(f);
        return area_vector(a, b, c);
    };
    int count = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v}) || mesh[VertexId{v}].label_count < 3) continue;
        mesh.for_star(VertexId{v}, [&](FaceId f, int at) {
            mesh.for_star(VertexId{v}, [&](FaceId g, int other_at) {
                const bool is_beside = mesh[f].vertices[place_after(at)] == mesh[g].vertices[place_before(other_at)] &&
                                       mesh[f].has_labels(mesh[g].labels);
                count += is_beside && dot(normal_of(f), normal_of(g)) < 0;
            });
        });
    }
    return count;
}

TEST(Prepass, removes_folds_beside_lines) {
    Mesh mesh = smoothed(test::grain_volume({24, 24, 24}, 12, 5));
    with_prepass(mesh, 1e-3, {}, [&](Prepass& prepass) {
        const int before = folds_of(mesh);
        ASSERT_GT(before, 20);
        prepass.find(Prepass::Fault::kFold, 2);
        VerdictCounts verdicts{};
        while (prepass.remove(Prepass::Fault::kFold, verdicts) > 0) {
        }
        EXPECT_LT(folds_of(mesh), before * 2 / 3);
    });
    test::expect_sound(check(mesh));
}

TEST(Prepass, leaves_folds_of_models_that_may_have_them) {
    const auto left = [&](bool removes_folds) {
        Mesh mesh = smoothed(test::grain_volume({24, 24, 24}, 12, 5));
        simplify(mesh, {.target_faces = mesh.face_count() * 3 / 4, .removes_folds = removes_folds});
        return folds_of(mesh);
    };
    EXPECT_LT(left(true), left(false));
}

}  // namespace
}  // namespace regionmesh
