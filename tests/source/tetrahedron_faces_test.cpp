#include "regionmesh/source/tetrahedron_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regionmesh/base/error.h"
#include "regionmesh/pipeline.h"
#include "support/digest.h"
#include "support/meshes.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using test::expect_sound;
using test::plain;
using test::reduced;
using test::surface_digest;
using testing::HasSubstr;

Reconstruction run(test::ArrayMesh mesh, const ReconstructOptions& options = plain()) {
    ReconstructOptions own = options;
    if (!own.sweep) own.sweep = kSweepZ;
    return reconstruct(mesh, own);
}

std::string refusal(test::ArrayMesh mesh, const ReconstructOptions& options = plain()) {
    try {
        run(std::move(mesh), options);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing thrown";
}

void expect_same_surface(const Reconstruction& a, const Reconstruction& b) {
    expect_sound(a.report.check);
    expect_sound(b.report.check);
    EXPECT_EQ(a.report.initial_faces, b.report.initial_faces);
    EXPECT_EQ(a.report.initial_vertices, b.report.initial_vertices);
    EXPECT_EQ(a.model.face_count(), b.model.face_count());
    EXPECT_EQ(a.model.vertex_count(), b.model.vertex_count());
    EXPECT_EQ(surface_digest(a.model), surface_digest(b.model));
    ASSERT_EQ(a.report.check.regions.size(), b.report.check.regions.size());
    for (std::size_t n = 0; n < a.report.check.regions.size(); ++n) {
        EXPECT_EQ(a.report.check.regions[n].label, b.report.check.regions[n].label);
        EXPECT_EQ(a.report.check.regions[n].euler, b.report.check.regions[n].euler);
    }
}

TEST(TetrahedronFaces, a_lattice_as_tetrahedra_is_the_model_of_its_sections) {
    for (const test::ArrayVolume& volume :
         {test::grain_volume({17, 14, 12}, 8, 1), test::noise_volume({9, 8, 10}, 5, 2), test::solid_volume({4, 3, 5})})
        for (const ReconstructOptions& options :
             {plain(), ReconstructOptions{.smooth = {.passes = 0}, .decimate = false},
              ReconstructOptions{.smooth = {.passes = 0}, .decimate = false, .cap = false}}) {
            test::ArrayVolume sections = volume;
            expect_same_surface(run(test::mesh_of(volume), options), test::run(sections, options));
        }
}

TEST(TetrahedronFaces, a_lattice_as_tetrahedra_is_smoothed_and_decimated_as_its_sections_are) {
    for (const test::ArrayVolume& volume : {test::grain_volume({30, 28, 40}, 20, 1), test::noise_volume({9, 8, 10}, 5, 2)})
        for (const ReconstructOptions& options :
             {ReconstructOptions{.decimate = false, .background = {}}, reduced(0.9),
              ReconstructOptions{.reduce = 0.9, .background = {}}}) {
            test::ArrayVolume sections = volume;
            expect_same_surface(run(test::mesh_of(volume), options), test::run(sections, options));
        }
}

}  // namespace
}  // namespace regionmesh
