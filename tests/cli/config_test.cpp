// Options from a file, and from the report of an earlier run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

class Config : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("ball.raw");
    }

    std::string input() const { return path("ball.raw").string(); }
    std::string toml(const std::string& text) const {
        put_text(path("run.toml"), text);
        return path("run.toml").string();
    }
    std::string whole() const {
        return "input = [\"" + input() + "\"]\nsize = [9, 9, 9]\ntype = \"uint8\"\noutput = \"" + out("m.vtp") + "\"\n";
    }
};

TEST_F(Config, holds_a_whole_run) {
    const std::string all = "# a run\n[reconstruct]\n" + whole() +
                            "background = [0, 7]\nreduce = \"50%\"\nno_decimate = false\nquiet = true\n"
                            "[check]\njson = \"x\"\n";
    const Ran ran = run("reconstruct --config " + toml(all));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(ran.out, "") << "quiet";
    const std::string made = text_of(out("m.vtp"));
    const Ran typed = run("reconstruct " + input() + " --size 9,9,9 --type uint8 --background 0,7 --reduce 50% -o " +
                          out("typed.vtp"));
    EXPECT_EQ(typed.code, 0) << typed.error;
    EXPECT_TRUE(made == text_of(out("typed.vtp")));
}

TEST_F(Config, with_a_name_of_many_parts_is_refused_at_once) {
    std::string name = "a";
    for (int part = 0; part < 100'000; ++part) name += ".a";
    const std::string file = toml(whole() + "[" + name + "]\n");
    expect_refusal("reconstruct --config " + file, 1, "run.toml: line 5: a name of more than 100 parts");
    expect_refusal("reconstruct --config " + toml(name + " = 1\n"), 1, "line 1: a name of more than 100 parts");
    std::string inputs;
    for (int n = 0; n < 120; ++n) inputs += std::string(n > 0 ? ", " : "") + "\"v.raw\"";
    for (const std::string& more : {"# " + std::string(200, '.'), "labels = [" + inputs + "]"})
        EXPECT_THAT(run("reconstruct --config " + toml(more + '\n')).error, Not(HasSubstr("a name of more"))) << more;
}

TEST_F(Config, gives_way_to_the_command_line) {
    const std::string file = toml(whole() + "reduce = \"50%\"\n");
    const Ran ran = run("reconstruct --reduce 0% --report " + out("r.json") + " --config " + file);
    EXPECT_EQ(ran.code, 0) << ran.error;
    const auto report = nlohmann::json::parse(text_of(out("r.json")));
    EXPECT_EQ(report["options"]["reduce"], "0%");
    EXPECT_EQ(report["initial_faces"], report["final_faces"]);
}

TEST_F(Config, of_a_report_makes_the_same_model_again) {
    const std::string typed = "reconstruct " + input() + " --size 9,9,9 --type uint8 --background 0 --background 7" +
                              " --reduce 50% --smooth strong -o " + out("m.vtp");
    ASSERT_EQ(run(typed + " --report " + out("r.json")).code, 0);
    const std::string made = text_of(out("m.vtp"));
    const auto report = nlohmann::json::parse(text_of(out("r.json")));
    EXPECT_EQ(report["command"], "reconstruct");
    EXPECT_EQ(report["options"]["background"], nlohmann::json({"0", "7"}));
    const Ran again =
        run("reconstruct --config " + out("r.json") + " --report " + out("again.json") + " -o " + out("again.vtp"));
    EXPECT_EQ(again.code, 0) << again.error;
    EXPECT_TRUE(made == text_of(out("again.vtp")));
    EXPECT_EQ(nlohmann::json::parse(text_of(out("again.json")))["options"]["smooth"], "strong");
    EXPECT_THAT(run("smooth --config " + out("r.json")).error,
                HasSubstr("holds the options of reconstruct, not of smooth"));
    EXPECT_THAT(run("reconstruct --config " + out("r.json")).error, HasSubstr("is the same file as"));
}

TEST_F(Config, that_is_wrong_is_refused_in_one_line) {
    const auto refused = [&](const std::string& text, int code, const std::string& said) {
        expect_refusal("reconstruct --config " + toml(text), code, said);
    };
    refused(whole() + "redcue = \"5%\"\n", 2, "run.toml: redcue: reconstruct has no such option; did you mean reduce?");
    refused(whole() + "config = \"x.toml\"\n", 2, "run.toml: config: ");
    refused(whole() + "[smoothing]\nreduce = \"5%\"\n", 2, "run.toml: [smoothing]: no command has this name");
    refused(whole() + "a.b = 1\n", 2, "run.toml: [a]: no command has this name");
    refused(whole() + "reduce = \"x\"\n", 2, "run.toml: --reduce x: not a share");
    refused(whole() + "reduce = \"5%\"\ntarget-faces = 10\n", 2, "--reduce and --target-faces: ");
    refused(whole() + "reduce = \"5%\"\nreduce = \"6%\"\n", 2, "run.toml: reduce is given twice");
    refused(whole() + "labels = [1]\nlabels = [2]\n", 2, "run.toml: labels is given twice");
    refused(whole() + "labels = [1]\nsmooth = \"off\"\nlabels = [2]\n", 2, "run.toml: labels is given twice");
    refused(whole() + "min_quality = 0.1\n[reconstruct]\nmin-quality = 0.2\n", 2, "min-quality is given twice");
    refused(whole() + "labels = [1]\n; labels\n; x = 1\nlabels = [2]\n", 2, "labels is given twice");
    refused(whole() + "[check]\nthreads = 1\n\nquiet = true\nthreads = 2\n", 2, "threads is given twice");
    refused(whole() + "= 5\n", 2, "has no name; give NAME = VALUE");
    refused("reduce = \"5%\"\n", 2, "input is required");
    refused("input = [\"a.npy\"]\n", 2, "--output is required");
    refused("input = [\"a#b.npy\"]\n", 1, "run.toml: line 1: a value with #");
    expect_refusal("reconstruct --config " + path("none.toml").string(), 1, "none.toml: cannot be read");
    expect_refusal("reconstruct --config " + path("none.json").string(), 1, "none.json: no such file");
    put_text(path("other.json"), "{\"a\": 1}");
    expect_refusal("reconstruct --config " + path("other.json").string(), 1, "other.json: has no options");
}

TEST_F(Config, with_a_byte_order_mark_is_read) {
    EXPECT_EQ(run("reconstruct --config " + toml("\xEF\xBB\xBF" + whole())).code, 0);
}

TEST_F(Config, with_a_comment_is_read) {
    EXPECT_EQ(run("reconstruct --config " + toml(whole() + "reduce = \"5%\"  # it's a test \n")).code, 0);
    EXPECT_EQ(run("reconstruct --config " + toml(whole() + "; smooth = 1\n; smooth = 2\n; = 3\n")).code, 0);
}

}  // namespace
}  // namespace regionmesh
