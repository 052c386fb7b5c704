#include "regionmesh/stream/weld.h"

#include <gtest/gtest.h>

#include "regionmesh/decimate/decimate.h"
#include "regionmesh/stream/section_window.h"
#include "regionmesh/tets/strip_mesher.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// Meshes a volume strip by strip; after each weld calls visit(model, weld, z of the last section).
template <class Visit>
Model welded(test::ArrayVolume volume, Visit&& visit) {
    LabelTable labels;
    SectionWindow window(volume, labels);
    StripMesher mesher(volume.info().lattice, kSweepZ, {});
    Model model;
    Weld weld(model);
    FaceBatch batch;
    while (window.advance()) {
        batch.clear();
        mesher.mesh(window.low(), window.high(), batch);
        weld.add(batch);
        visit(model, weld, window.sections_read() - 1.0);
    }
    return model;
}

test::ArrayVolume grains() { return test::grain_volume({8, 8, 8}, 6, 2); }

TEST(Weld, the_front_is_what_lies_on_the_last_section_and_is_fixed) {
    welded(grains(), [](const Model& model, const Weld&, double z) {
        std::uint32_t front = 0;
        test::for_vertices(model, [&](VertexId v) {
            const bool is_front = model.position(v).z == z && z < 7;
            EXPECT_EQ(model[v].is_fixed, is_front);
            front += is_front;
        });
        EXPECT_EQ(front == 0, z == 7) << "at the end nothing is open";
    });
}

TEST(Weld, makes_no_vertex_twice) {
    const Model model = welded(grains(), [](const Model&, const Weld&, double) {});
    test::expect_sound(check(model));
}

TEST(Weld, follows_a_front_that_got_new_ids) {
    const Model plain = welded(grains(), [](const Model&, const Weld&, double) {});
    const Model sorted = welded(grains(), [](Model& model, Weld& weld, double) { weld.renumber(model.sort_spatially()); });
    EXPECT_EQ(test::surface_digest(sorted), test::surface_digest(plain));
    test::expect_sound(check(sorted));
}

TEST(Weld, puts_together_what_it_took_apart) {
    const Model plain = welded(grains(), [](const Model&, const Weld&, double) {});
    const Model again = welded(grains(), [](Model& model, Weld& weld, double) {
        const std::size_t front = weld.front().size();
        const FaceBatch whole = weld.take_apart();
        EXPECT_EQ(whole.open.size(), front);
        EXPECT_EQ(model.face_count(), 0u);
        weld.add(whole);
    });
    EXPECT_EQ(test::surface_digest(again), test::surface_digest(plain));
}

TEST(Weld, joins_what_was_decimated_up_to_the_front) {
    const Model model = welded(grains(), [](Model& part, Weld& weld, double z) {
        weld.renumber(part.sort_spatially());
        DecimateOptions options;
        options.limits.high.z = z;
        decimate(part, options);
    });
    test::expect_sound(check(model));
    EXPECT_LT(model.face_count(), welded(grains(), [](const Model&, const Weld&, double) {}).face_count() / 2);
}

TEST(SectionWindow, hands_out_consecutive_sections_with_dense_labels) {
    test::TextVolume volume({{"77", "77"}, {"75", "77"}, {"99", "55"}});
    LabelTable labels;
    SectionWindow window(volume, labels);
    ASSERT_TRUE(window.advance());
    EXPECT_EQ(std::vector(window.low().begin(), window.low().end()), (std::vector<Label>{0, 0, 0, 0}));
    EXPECT_EQ(std::vector(window.high().begin(), window.high().end()), (std::vector<Label>{0, 1, 0, 0}));
    EXPECT_FALSE(window.is_last());
    ASSERT_TRUE(window.advance());
    EXPECT_EQ(std::vector(window.low().begin(), window.low().end()), (std::vector<Label>{0, 1, 0, 0}));
    EXPECT_EQ(std::vector(window.high().begin(), window.high().end()), (std::vector<Label>{2, 2, 1, 1}));
    EXPECT_TRUE(window.is_last());
    EXPECT_FALSE(window.advance());
    EXPECT_EQ(labels.input(2), 9);
}

}  // namespace
}  // namespace regionmesh
