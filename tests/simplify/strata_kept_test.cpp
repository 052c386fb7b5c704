// Whatever decimation does, the list of all strata stays.
#include <gtest/gtest.h>

#include "regionmesh/simplify.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

struct Input {
    const char* name;
    test::ArrayVolume volume;
    ReconstructOptions options = test::plain();
};

std::vector<Input> inputs() {
    std::vector<Input> all{{"solid", test::solid_volume({5, 5, 5})},
                           {"ball", test::ball_volume({9, 9, 9}, 3)},
                           {"two labels", test::noise_volume({7, 7, 7}, 2, 1)},
                           {"four labels", test::noise_volume({7, 7, 7}, 4, 2)},
                           {"many labels", test::noise_volume({6, 6, 6}, 100, 3)},
                           {"grains", test::grain_volume({12, 12, 12}, 9, 4)},
                           {"flat grains", test::grain_volume({9, 9, 9}, 9, 5).spaced({1, 2, 5})}};
    all.push_back({"background", test::noise_volume({7, 7, 7}, 3, 6), {.decimate = false, .background = {0}}});
    all.push_back(
        {"grains and background", test::grain_volume({12, 12, 12}, 9, 7), {.decimate = false, .background = {0, 3}}});
    all.push_back({"open", test::noise_volume({6, 6, 6}, 3, 8), {.decimate = false, .cap = false, .background = {}}});
    return all;
}

TEST(StrataKept, when_decimated_as_far_as_topology_allows) {
    for (Input& input : inputs()) {
        SCOPED_TRACE(input.name);
        Mesh mesh = test::run(input.volume, input.options).mesh;
        const test::StrataList before = test::list_strata(mesh);
        simplify(mesh, {});
        test::expect_same_strata(test::list_strata(mesh), before);
    }
}

TEST(StrataKept, with_neither_quality_nor_intersect_verdicts) {
    for (Input& input : inputs()) {
        SCOPED_TRACE(input.name);
        Mesh mesh = test::run(input.volume, input.options).mesh;
        const test::StrataList before = test::list_strata(mesh);
        simplify(mesh, {.promises = {.min_quality = 0, .intersect_check = false}, .perturbation = 1e-3});
        test::expect_same_strata(test::list_strata(mesh), before);
    }
}

TEST(StrataKept, and_every_vertex_stays_generic) {
    for (Input& input : inputs()) {
        if (!input.options.cap || !input.options.background.empty()) continue;
        SCOPED_TRACE(input.name);
        Mesh mesh = test::run(input.volume, input.options).mesh;
        simplify(mesh, {});
        test::expect_generic(mesh);
    }
}

/// Every sample of label 1 in these is a pocket of its own: on an edge, a side, a corner of the box, across a side.
const std::vector<std::vector<test::TextVolume::Section>> kPockets{
    {{"00", "00"}, {"10", "00"}, {"00", "00"}},
    {{"000", "010", "000"}, {"000", "000", "000"}},
    {{"10", "00"}, {"00", "00"}},
    {{"0000", "0110", "0000"}, {"0000", "0000", "0000"}},
    {{"000", "010", "000"}, {"000", "010", "000"}},
};

TEST(StrataKept, pockets_on_the_box_without_caps) {
    for (std::size_t n = 0; n < kPockets.size(); ++n)
        for (bool cap : {true, false})
            for (const std::vector<InputLabel>& background : {std::vector<InputLabel>{}, {0}, {1}}) {
                SCOPED_TRACE("pocket " + std::to_string(n) + (cap ? ", capped" : ", open") +
                             (background.empty() ? "" : ", background " + std::to_string(background[0])));
                test::TextVolume volume(kPockets[n]);
                Mesh mesh = test::run(volume, {.decimate = false, .cap = cap, .background = background}).mesh;
                const test::StrataList before = test::list_strata(mesh);
                simplify(mesh, {});
                test::expect_same_strata(test::list_strata(mesh), before);
                EXPECT_GT(mesh.face_count(), 0u);
            }
}

TEST(StrataKept, after_a_decimated_model_is_decimated_again) {
    Mesh mesh = test::run(test::grain_volume({12, 12, 12}, 9, 4)).mesh;
    const test::StrataList before = test::list_strata(mesh);
    for (std::uint32_t target : {2000u, 1000u, 500u, 0u}) {
        simplify(mesh, {.target_faces = target});
        mesh.sort_spatially();
        test::expect_same_strata(test::list_strata(mesh), before);
    }
    test::expect_sound(check(mesh));
}

}  // namespace
}  // namespace regionmesh
