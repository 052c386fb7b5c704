#include "simplify/verdict/rising_faces.h"

#include <gtest/gtest.h>

#include <bit>

#include "simplify/collapse_edges.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

constexpr int kDirections = 26;

Directions opposite(Directions directions) { return directions << 16 | directions >> 16; }

TEST(RisingFaces, a_face_rises_along_half_of_the_directions_and_falls_along_their_opposites) {
    const Mesh mesh = test::octahedron();
    const RisingFaces rising(mesh);
    test::for_faces(mesh, [&](FaceId f) {
        const Directions own = rising[f];
        EXPECT_EQ(own & opposite(own), 0u);
        // Normals are (1, 1, 1) and the like: square to six of the directions.
        EXPECT_EQ(std::popcount(own), (kDirections - 6) / 2);
    });
}

TEST(RisingFaces, faces_of_a_box_rise_along_no_common_direction) {
    const Mesh mesh = test::run(test::solid_volume({3, 3, 3})).mesh;
    const RisingFaces rising(mesh);
    Directions all = ~0u;
    test::for_faces(mesh, [&](FaceId f) {
        EXPECT_EQ(std::popcount(rising[f]), 9);
        all &= rising[f];
    });
    EXPECT_EQ(all, 0u);
}

TEST(RisingFaces, a_needle_rises_along_none) {
    const Mesh mesh = test::shape({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}}, {{{0, 1, 2}, {0, 1}}});
    EXPECT_EQ(RisingFaces(mesh)[FaceId{0}], 0u);
}

TEST(RisingFaces, a_star_rises_with_all_its_faces_before_and_after) {
    Mesh mesh = test::edge_in_sheet();
    RisingFaces rising(mesh);
    EdgeStar star;
    gather(mesh, VertexId{0}, VertexId{1}, star);
    const Vec3 middle = 0.5 * (star.at_goes + star.at_stays);
    set_normals(star, middle);
    const Directions flat = rising.common(star, middle);
    EXPECT_EQ(std::popcount(flat), 9);
    const Vec3 high = middle + Vec3{0, 0, 100};  // along the sheet's normal or against it
    set_normals(star, high);
    EXPECT_LT(std::popcount(rising.common(star, high)), 9);
    rising.set(star, high);
    Directions all = ~0u;
    for (const StarFace& face : star.faces) all &= rising[face.face];
    EXPECT_EQ(rising.common(star, high), flat & all);
}

/// What collapses make of the surface of a volume, where it is known that its faces bound regions and where it is not.
void expect_the_same_collapses(test::ArrayVolume& volume, const ReconstructOptions& surface, SimplifyOptions options) {
    Mesh searched = test::run(volume, surface).mesh, known = test::run(volume, surface).mesh;
    options.bounds_regions = false;
    const CollapseResult expected = collapse_edges(searched, options);
    options.bounds_regions = true;
    const CollapseResult done = collapse_edges(known, options);
    EXPECT_EQ(test::digest(known), test::digest(searched));
    EXPECT_EQ(done.verdicts, expected.verdicts);
    EXPECT_GT(done.verdicts[static_cast<int>(Verdict::kAccepted)], 100u);
}

TEST(RisingFaces, models_are_those_of_the_whole_test) {
    for (const CellKind cells : {CellKind::kTetrahedra, CellKind::kCompact})
        for (const std::uint32_t passes : {0u, 20u}) {
            ReconstructOptions surface = test::plain();
            surface.cells = cells;
            surface.smooth.passes = passes;
            test::ArrayVolume volumes[] = {
                test::noise_volume({12, 11, 10}, 3, 1), test::noise_volume({12, 11, 10}, 2, 1),
                test::grain_volume({18, 17, 16}, 6, 1), test::ball_volume({20, 20, 20}, 7.3)};
            for (test::ArrayVolume& volume : volumes) expect_the_same_collapses(volume, surface, {});
        }
}

}  // namespace
}  // namespace regionmesh
