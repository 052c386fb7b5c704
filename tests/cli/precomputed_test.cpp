// Folders for Neuroglancer, as a user makes them.
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class PrecomputedProgram : public Program {
protected:
    /// Reconstructs grains of 24 samples along each axis into out/model, in blocks of 12 cells.
    Ran make_model(const std::string& options = "") const {
        const test::ArrayVolume volume = test::grain_volume({24, 24, 24}, 8, 3);
        std::string labels(volume.labels().begin(), volume.labels().end());
        put_text(path("grains.raw"), labels);
        return run("reconstruct " + path("grains.raw").string() +
                   " --size 24,24,24 --type uint8 --smooth light --block-size 12 -o " + out("model") + ' ' + options);
    }

    nlohmann::json json_of(const std::string& name) const { return nlohmann::json::parse(text_of(out(name))); }
};

TEST_F(PrecomputedProgram, says_the_names_of_the_table_given_with_the_volume) {
    put_text(path("names.csv"), "label,name\n1,quartz\n");
    ASSERT_EQ(make_model("--names " + path("names.csv").string()).code, 0);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("m.precomputed")).code, 0);
    const auto properties = json_of("m.precomputed/names/info")["inline"];
    ASSERT_EQ(properties["ids"].size(), properties["properties"][0]["values"].size());
    for (std::size_t n = 0; n < properties["ids"].size(); ++n) {
        const std::string id = properties["ids"][n];
        EXPECT_EQ(properties["properties"][0]["values"][n], id == "1" ? "quartz" : id);
    }
}

TEST_F(PrecomputedProgram, writes_a_state_that_shows_the_model_in_its_colours) {
    ASSERT_EQ(make_model().code, 0);
    put_text(path("colours.csv"), "label,name,colour\n1,quartz,#ff8000\n2,mica,#0000ff\n");
    const Ran ran = run("convert " + out("model") + ' ' + out("m.precomputed") + " --units um --names " +
                        path("colours.csv").string());
    ASSERT_EQ(ran.code, 0) << ran.error;
    const auto state = json_of("m.precomputed/state.json"), layer = state["layers"][0];
    EXPECT_EQ(layer["source"], "precomputed://http://localhost:8080/m.precomputed");
    EXPECT_EQ(layer["segments"].size(), json_of("m.precomputed/names/info")["inline"]["ids"].size());
    EXPECT_EQ(layer["segmentColors"]["1"], "#ff8000");
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(state["position"][axis], 11500, 1);  // nanometres
}

TEST_F(PrecomputedProgram, refuses_negative_labels_before_it_writes) {
    put_text(path("grains.raw"), std::string(12, '\xfe') + std::string(15, '\x01'));  // -2 and 1
    ASSERT_EQ(run("reconstruct " + path("grains.raw").string() + " --size 3,3,3 --type int8 --block-size 12 -o " +
                  out("model"))
                  .code,
              0);
    const Ran ran = run("convert " + out("model") + ' ' + out("m.precomputed"));
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
    EXPECT_THAT(ran.error, testing::HasSubstr("label -2 is negative, and ids in Neuroglancer are not"));
    EXPECT_FALSE(fs::exists(out("m.precomputed/info")));
}

}  // namespace
}  // namespace regionmesh
