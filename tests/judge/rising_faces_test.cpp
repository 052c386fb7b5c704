#include "judge/verdict/rising_faces.h"

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

/// Drawn at random: a star of this volume would fold over faces that are joined to it.
test::TextVolume folding_volume() {
    return test::TextVolume({
        {"55555555554444", "55555555554544", "55555565554444", "55555555555444", "55555555555544", "55555555555544",
         "55555555555554", "55555555555554", "55555555555555", "55555556555555", "55555555555555", "55555555555555",
         "55555555555555", "55555555555555", "55555555555555", "55555655555555", "55556666655555", "55566666655555",
         "55666666655555", "44566666665555", "44666666665555", "44466666664555", "44466666566555", "44446666566555",
         "44446666666555", "54444666666655", "44444466666655", "44444466666655", "55555555555552"},
        {"55555525554454", "55555555554444", "55555555554444", "55555555554444", "55555555555444", "55555555555544",
         "55555555555544", "55555555555554", "55556555555555", "55555555555555", "55555555555555", "55555555555555",
         "55555555555555", "55555555556555", "55555555555555", "55555555555555", "55555566655555", "52556666655555",
         "55666666665555", "44666666665555", "44666666665555", "44466666666555", "44466666666555", "44446666666555",
         "44446666666655", "44464666666655", "44444666666655", "44444466666665", "55555555555552"},
        {"55555555554444", "55555555554444", "55555555554544", "55555555555444", "55555555555444", "55555555555544",
         "55555555555544", "55555555555554", "55555555555555", "55555555555555", "55555555555555", "55555554555555",
         "55555555555555", "55555555555555", "55555555555555", "55555565555555", "55555666555555", "55556666655555",
         "55566666655555", "55666666665555", "44666666666555", "44466666666555", "44466666666555", "44446666666555",
         "44446666666655", "44544666665655", "44444666666665", "44444466666665", "55555555555552"},
        {"55555555555454", "55555555554445", "55555555554444", "55555565554444", "55555555555444", "55555555555444",
         "55555555555544", "55555555555554", "55555555555554", "55555555555555", "55555555555555", "55555555555555",
         "55555555555555", "55555555555555", "55552555555555", "55555555555555", "55555665555555", "55556666555555",
         "55566666645555", "55666666455555", "44662666665555", "44666626666555", "44466666666555", "44466666666655",
         "44446666666665", "44444666266665", "44454666666665", "44444466666666", "55555555555552"},
        {"55555555555444", "55555555555544", "55555555554444", "55555555554444", "55555555554444", "55555555555444",
         "55555555555544", "55555555555544", "55555555555554", "55555555555555", "55555555555555", "55555555555555",
         "55555555555555", "55555555555555", "55555555555555", "55555555555555", "55555655555555", "55556665555555",
         "55566666555545", "55666666555555", "44666666655555", "44666666665555", "44465666665555", "44466666666555",
         "44446666626655", "44446666666665", "44444666666665", "44444666666662", "55555555555552"},
    });
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

TEST(RisingFaces, faces_joined_to_the_star_are_not_swept_over) {
    test::TextVolume volume = folding_volume();
    volume.swept(kSweepY);
    const Reconstruction made = test::run(volume, {.promises = {.min_quality = 0.05, .max_error = 0.3},
                                                   .cells = CellKind::kTetrahedra,
                                                   .keep_samples = false,
                                                   .cap = false,
                                                   .background = {}});
    test::expect_sound(made.report.check);
}

}  // namespace
}  // namespace regionmesh
