// What info says about volumes, points and models, and compare about names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/program.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Info : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        std::string layers;  // 30 labels, one for each section
        for (char label = 0; label < 30; ++label) layers += std::string(9, label);
        put_text(path("layers.raw"), layers);
        put_text(path("names.csv"), "1,femur\n2,tibia\n");
    }
    std::string layers() const { return path("layers.raw").string() + " --size 3,3,30 --type uint8"; }
    void make_model() const {
        ASSERT_EQ(
            run("reconstruct " + layers() + " --names " + path("names.csv").string() + " -o " + out("m.vtp")).code, 0);
    }
    nlohmann::json json(const std::string& of) const {
        const Ran ran = run("info " + of + " --json " + out("i.json"));
        EXPECT_EQ(ran.code, 0) << ran.error;
        return nlohmann::json::parse(text_of(out("i.json")));
    }
};

TEST_F(Info, lists_20_labels_or_all) {
    EXPECT_THAT(run("info " + layers()).out, AllOf(HasSubstr("19  9 samples\n  and 10 more; --all lists them\n")));
    EXPECT_THAT(run("info --all " + layers()).out, AllOf(HasSubstr("29  9 samples\n"), Not(HasSubstr("more;"))));
}

TEST_F(Info, says_the_least_memory_that_is_accepted) {
    std::string noise;
    for (std::uint32_t n = 0, bits = 7; n < 20 * 20 * 20; ++n)
        noise += static_cast<char>((bits = bits * 1664525 + 1013904223) >> 28);
    put_text(path("noise.raw"), noise);
    const std::string volume = path("noise.raw").string() + " --size 20,20,20 --type uint8";
    const std::string said = run("info " + volume).out;
    const auto least = [&](std::string_view before) {
        const std::size_t at = said.find(before);
        return at == std::string::npos ? 0 : std::stoi(said.substr(at + before.size()));
    };
    const int whole = least("memory     "), reduced = least("at least, ");
    ASSERT_GT(whole, 20);
    ASSERT_GT(reduced, 20);
    const std::string to = " --quiet -o " + out("m.vtp");
    for (const auto& [megabytes, options] : {std::pair(whole, ""), std::pair(reduced, " --reduce 80%")}) {
        const std::string reconstruct = "reconstruct " + volume + options + to + " --memory ";
        expect_refusal(reconstruct + std::to_string(megabytes - 1) + "MB", 1, "needs at least");
        EXPECT_EQ(run(reconstruct + std::to_string(megabytes) + "MB").code, 0);
        std::filesystem::remove(out("m.vtp"));
    }
}

TEST_F(Info, writes_json_with_all_labels_of_a_volume) {
    const auto info = json(layers());
    EXPECT_EQ(info["kind"], "volume");
    EXPECT_EQ(info["size"], nlohmann::json({3, 3, 30}));
    ASSERT_EQ(info["labels"].size(), 30u);
    EXPECT_EQ(info["labels"][29], nlohmann::json({{"label", 29}, {"samples", 9}}));
    EXPECT_GT(info["unsimplified_faces"], 100);
}

TEST_F(Info, writes_json_of_points) {
    put_text(path("points.csv"), "x,y,z,label\n0,0,0,1\n1,0,0,1\n0,1,0,2\n0,0,1,2\n1,1,1,2\n");
    const auto info = json(path("points.csv").string());
    EXPECT_EQ(info["kind"], "tetrahedra");
    EXPECT_EQ(info["labels"][0], nlohmann::json({{"label", 1}, {"points", 2}}));
}

TEST_F(Info, knows_models_with_their_names) {
    make_model();
    const Ran ran = run("info " + out("m.vtp"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, AllOf(HasSubstr("(surface model)"), HasSubstr("regions    29\n"), HasSubstr("  femur\n"),
                               HasSubstr("and 9 more; --all lists them")));
    const auto info = json(out("m.vtp"));
    EXPECT_EQ(info["kind"], "model");
    EXPECT_EQ(info["regions"].size(), 29u);
    EXPECT_EQ(info["regions"][1]["name"], "tibia");
    EXPECT_GT(info["regions"][1]["volume"], 0);
    EXPECT_EQ(info["box"]["low"][0], 0);
    std::filesystem::rename(out("m.vtp"), out("M.VTP"));
    EXPECT_EQ(json(out("M.VTP"))["regions"], info["regions"]);
}

TEST_F(Info, of_a_file_that_is_neither_says_what_is_wrong_with_it) {
    put_text(path("a.vtu"), "nothing");
    expect_refusal("info " + path("a.vtu").string(), 1, "a.vtu: ");
}

TEST_F(Info, has_no_minus_zero) {
    std::string header =
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 30\nencoding: raw\n"
        "space: left-posterior-superior\nspace directions: (-1,-0,0) (0,-1,-0) (0,0,1)\n"
        "space origin: (-0,0,-0)\n\n";
    put_text(path("turned.nrrd"), header + text_of(path("layers.raw")));
    const Ran ran = run("info " + path("turned.nrrd").string());
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("direction  ["));
    EXPECT_THAT(ran.out, AllOf(Not(HasSubstr("-0 ")), Not(HasSubstr("-0]")), Not(HasSubstr("-0,"))));
}

TEST_F(Info, has_its_names_in_comparisons) {
    make_model();
    const Ran ran = run("compare " + out("m.vtp") + ' ' + out("m.vtp") + " --samples 1000 --json " + out("c.json"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, AllOf(HasSubstr("\nfemur "), HasSubstr("\nfemur|tibia ")));
    const auto report = nlohmann::json::parse(text_of(out("c.json")));
    int named = 0;
    for (const auto& region : report["regions"]) {
        named += region.contains("name");
        EXPECT_TRUE(region["label"] != 2 || region["name"] == "tibia");
    }
    EXPECT_EQ(named, 2);
}

}  // namespace
}  // namespace regionmesh
