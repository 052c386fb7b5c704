// What a user gets who typed something else than was meant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "cli/program.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Usage : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("ball.raw");
        put_text(path("empty.raw"), std::string(9 * 9 * 9, '\0'));
    }

    std::string of(const std::string& file, const std::string& more = "") const {
        return path(file + ".raw").string() + " --size 9,9,9 --type uint8 " + more;
    }
    /// Writes a volume like that of the ball, of the upper bits of random numbers of 32 bits.
    void put_noise(int bits_without) const {
        std::string noise;
        for (std::uint32_t n = 0, bits = 7; n < 729; ++n)
            noise += static_cast<char>((bits = bits * 1664525 + 1013904223) >> bits_without);
        put_text(path("noise.raw"), noise);
    }
    std::string to_model() const { return " -o " + out("m.vtp"); }
    std::string reconstruct_ball(const std::string& more = "") const {
        return "reconstruct " + of("ball", more) + to_model();
    }
};

TEST_F(Usage, options_that_contradict_each_other_are_refused_by_name) {
    const auto refused = [&](const std::string& options, const std::string& a, const std::string& b) {
        expect_refusal(reconstruct_ball(options), 2, a + " and " + b + ": ");
    };
    refused("--reduce 90% --target-faces 1000", "--reduce", "--target-faces");
    refused("--no-decimate --reduce 50%", "--no-decimate", "--reduce");
    refused("--no-decimate --target-faces 50", "--no-decimate", "--target-faces");
    refused("--no-decimate --max-error 1", "--no-decimate", "--max-error");
    refused("--no-background --background 3", "--no-background", "--background");
    refused("--quiet --verbose", "--quiet", "--verbose");
    refused("--face-budget 1000 --memory 1GB", "--face-budget", "--memory");
    refused("--smooth-filter none --smooth 50", "--smooth-filter none", "--smooth 50");
    refused("--smooth off --smooth-filter taubin", "--smooth off", "--smooth-filter taubin");
    refused("--smooth 0 --smooth-points", "--smooth 0", "--smooth-points");
    EXPECT_EQ(run(reconstruct_ball("--smooth off --smooth-filter none --no-decimate")).code, 0);
    EXPECT_EQ(run(reconstruct_ball("--face-budget 1000 --memory 1GB --memory-limit hard")).code, 0);
}

TEST_F(Usage, options_that_the_lattice_filter_does_not_follow_are_a_warning) {
    const auto said = [&](const std::string& options) { return run(reconstruct_ball(options)).error; };
    EXPECT_THAT(said("--smooth 50"),
                HasSubstr("warning: --smooth 50: without effect, since the filter lattice has no passes"));
    EXPECT_THAT(said("--smooth-points"), HasSubstr("warning: --smooth-points: "));
    EXPECT_THAT(said("--smooth-lambda 0.3"), HasSubstr("warning: --smooth-lambda: "));
    for (const char* options : {"--smooth 20", "--smooth light", "--smooth 0", "--smooth off",
                                "--smooth-filter taubin --smooth 50 --smooth-points --smooth-lambda 0.3"})
        EXPECT_EQ(said(options), "") << options;
}

TEST_F(Usage, labels_may_be_named) {
    put_text(path("names.csv"), "label,name\n1,The ball\n");
    const std::string names = " --names " + path("names.csv").string();
    for (const std::string option : {"--labels 'the ball'", "--labels '0,The Ball'", "--background 0,5"}) {
        const Ran ran = run(reconstruct_ball(option + names));
        EXPECT_EQ(ran.code, 0) << option << ran.error;
        EXPECT_THAT(ran.out, HasSubstr("made: 1 region, ")) << option;
    }
    std::filesystem::remove(out("m.vtp"));
    expect_refusal(reconstruct_ball("--background 'The ball'" + names + " --labels 1"), 1, "no region");
    expect_refusal(reconstruct_ball("--labels liver" + names), 2, "--labels liver: ");
    expect_refusal(reconstruct_ball("--labels liver"), 2, "has no names: give labels, or --names TABLE");
}

TEST_F(Usage, a_length_may_have_a_unit) {
    const auto bytes = [&](const std::string& options) {
        EXPECT_EQ(run(reconstruct_ball(options)).code, 0) << options;
        return text_of(out("m.vtp"));
    };
    EXPECT_EQ(bytes("--units mm --max-error 0.2mm"), bytes("--units mm --max-error 0.2"));
    EXPECT_EQ(bytes("--units mm --max-error 200um"), bytes("--units mm --max-error 0.2"));
    std::filesystem::remove(out("m.vtp"));
    expect_refusal(reconstruct_ball("--max-error 0.2mm"), 2, "does not say its unit of length");
    expect_refusal(reconstruct_ball("--max-error 0.2furlong"), 2, "--max-error 0.2furlong: not a number");
}

TEST_F(Usage, without_a_target_faces_that_cost_nothing_go) {
    const Ran usual = run(reconstruct_ball()), whole = run(reconstruct_ball("--no-decimate"));
    const std::string model = text_of(out("m.vtp"));
    const Ran none = run(reconstruct_ball("--reduce 0"));
    EXPECT_EQ(text_of(out("m.vtp")), model) << "--reduce 0 decimates";
    EXPECT_THAT(usual.out, HasSubstr("no target was given: faces that cost nothing are gone"));
    EXPECT_THAT(whole.out, testing::Not(HasSubstr("no target")));
    const auto faces = [](const Ran& ran) {
        std::smatch found;
        EXPECT_TRUE(std::regex_search(ran.out, found, std::regex("region, ([0-9]+) faces?"))) << ran.out;
        return std::stoi(found[1]);
    };
    EXPECT_LT(faces(usual), faces(whole));
    EXPECT_EQ(faces(none), faces(whole));
}

TEST_F(Usage, a_missed_target_says_which_verdict_refused_most_and_what_to_try) {
    put_noise(30);
    const Ran ran = run("reconstruct " + of("noise", "--no-background --reduce 99%") + to_model());
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("stopped before the target"));
    EXPECT_THAT(ran.out, testing::ContainsRegex("[a-z]+: [0-9]+ % of the refusals: .*; try "));
}

TEST_F(Usage, smoothing_that_changes_nothing_says_so) {
    EXPECT_THAT(run(reconstruct_ball("--smooth strong --spacing 1,1,5")).error,
                HasSubstr("--smooth strong: without effect"));
    EXPECT_EQ(run(reconstruct_ball("--smooth strong")).error, "");
}

TEST_F(Usage, a_check_against_another_scan_says_first_what_does_not_fit) {
    const std::string model = path("m.vtp").string();
    ASSERT_EQ(run("reconstruct " + of("ball") + " -o " + model).code, 0);
    EXPECT_THAT(run("check " + model + " --sections " + of("ball", "--spacing 0.5,0.5,0.5")).out,
                testing::StartsWith("the extents do not fit: "));
    EXPECT_THAT(run("check " + model + " --sections " + of("empty")).out,
                testing::StartsWith("the labels do not fit: "));
    EXPECT_THAT(run("check " + model + " --sections " + of("ball")).out, testing::Not(HasSubstr("not fit")));
}

TEST_F(Usage, a_check_without_sections_takes_no_options_of_them) {
    const std::string model = path("m.vtp").string();
    ASSERT_EQ(run("reconstruct " + of("ball") + " -o " + model).code, 0);
    expect_refusal("check " + model + " --labels 1-3", 2, "--labels 1-3: ");
    expect_refusal("check " + model + " --room 0.4", 2, "--room 0.4: ");
    EXPECT_EQ(run("check " + model + " --background 0").code, 0);
}

TEST_F(Usage, sections_that_a_check_reads_twice_are_not_read_from_standard_input) {
    const std::string model = path("m.vtp").string();
    ASSERT_EQ(run("reconstruct " + of("ball") + " -o " + model).code, 0);
    expect_refusal("check " + model + " --sections - --size 9,9,9 --type uint8 < " + path("ball.raw").string(), 2,
                   "--sections -: ");
}

TEST_F(Usage, voxelise_writes_no_label_with_another_sign) {
    const auto put_labels = [&](const std::string& name, char high) {
        std::string bytes;
        for (int n = 0; n < 8; ++n) bytes += std::string(1, '\5') + std::string(6, '\0') + (n % 2 == 1 ? high : '\0');
        put_text(path(name), bytes);
    };
    const std::string model = path("m.vtp").string();
    put_labels("large.raw", '\x80');
    const std::string large = path("large.raw").string() + " --size 2,2,2 --type ";
    for (const auto& [type, other, said] :
         {std::tuple("uint64", "int64", "samples of int64 do not hold the label 9223372036854775813;"),
          std::tuple("int64", "uint64", "samples of uint64 do not hold the label -9223372036854775803;")}) {
        ASSERT_EQ(run("reconstruct " + large + type + " -o " + model).code, 0);
        EXPECT_EQ(run("voxelise " + model + " --like " + large + type + " -o " + out("v.raw")).code, 0);
        EXPECT_EQ(text_of(out("v.raw")), text_of(path("large.raw")));
        std::filesystem::remove(out("v.raw"));
        expect_refusal("voxelise " + model + " --like " + large + other + " -o " + out("v.raw"), 1, said);
    }
}

TEST_F(Usage, background_leaves_the_input_alone_and_takes_several_labels) {
    const std::string input = path("ball.raw").string() + " --size 9,9,9 --type uint8" + to_model();
    for (const std::string background : {"--background 0", "--background 0,7", "--background 0 7",
                                         "--background 0 --background 7", "--background=0"}) {
        const Ran ran = run("reconstruct " + background + ' ' + input);
        EXPECT_EQ(ran.code, 0) << background << ran.error;
        EXPECT_THAT(ran.out, HasSubstr("made: 1 region, ")) << background;
    }
    std::filesystem::remove(out("m.vtp"));
    expect_refusal("reconstruct --background 0-1 " + input, 1, "no region");
    expect_refusal(reconstruct_ball("--background 0,x"), 2, "has no names: give labels, or --names TABLE");
    expect_refusal(reconstruct_ball("--background 5-1"), 2, "--background 5-1: not ");
}

TEST_F(Usage, a_file_whose_name_is_a_number_is_an_input) {
    const std::string there = "cd '" + path("").string() + "' && ";
    put_text(path("7"), text_of(path("ball.raw")));
    const Ran ran = run("reconstruct --background 0 7 --size 9,9,9 --type uint8" + to_model(), there);
    EXPECT_THAT(ran.out, HasSubstr("made: 1 region, ")) << ran.error;
}

TEST_F(Usage, labels_that_do_not_occur_are_a_warning) {
    EXPECT_EQ(run(reconstruct_ball("--background 0")).error, "");
    const Ran background = run(reconstruct_ball("--background 0,500"));
    EXPECT_EQ(background.code, 0);
    EXPECT_THAT(background.error, AllOf(HasSubstr("warning: --background 500: "), HasSubstr("no such label")));
    EXPECT_THAT(run(reconstruct_ball("--labels 1,5-9")).error, HasSubstr("warning: --labels 5-9: "));
    EXPECT_EQ(run(reconstruct_ball("--labels 1 --background 0")).error, "");
    EXPECT_EQ(run(reconstruct_ball("--quiet --background 0,500")).error, "");
}

TEST_F(Usage, an_input_without_a_region_is_refused) {
    expect_refusal("reconstruct " + of("empty") + to_model(), 1,
                   "there is no region to model: all of it is background");
    expect_refusal(reconstruct_ball("--labels 4"), 1, "none of the --labels");
    expect_refusal(reconstruct_ball("--min-region 100000"), 1, "all of what --min-region left of it is background");
    expect_refusal("reconstruct " + of("empty", "--no-background --boundary open") + to_model(), 1,
                   "it has one label only");
}

TEST_F(Usage, one_section_is_a_plate) {
    const Ran ran = run("reconstruct " + path("ball.raw").string() + " --size 9,81,1 --type uint8" + to_model());
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.error, HasSubstr("it has one sample along z, and is repeated: the model is a plate"));
}

TEST_F(Usage, unknown_commands_and_options_are_answered_with_the_nearest) {
    expect_refusal("recnstruct a.npy", 2, "recnstruct: there is no such command; did you mean reconstruct?");
    expect_refusal("comp a b", 2, "did you mean compare?");
    expect_refusal("zzz", 2, "there is no such command; give reconstruct, decimate, ");
    expect_refusal("", 2, "give a command: reconstruct, decimate, ");
    expect_refusal(reconstruct_ball("--redcue 90%"), 2,
                   "--redcue: reconstruct has no such option; did you mean --reduce?");
    expect_refusal(reconstruct_ball("--background-label 0"), 2, "regionmesh reconstruct --help");
    expect_refusal("check m.vtp --reduce 5%", 2, "--reduce: check has no such option");
}

TEST_F(Usage, a_grey_scale_image_is_noticed) {
    put_noise(26);
    for (const std::string& command : {"info " + of("noise"), "reconstruct " + of("noise") + to_model()}) {
        const Ran ran = run(command);
        EXPECT_EQ(ran.code, 0);
        EXPECT_THAT(ran.error, HasSubstr("looks like a grey-scale image"));
    }
    EXPECT_EQ(run("info " + of("ball")).error, "");
}

TEST_F(Usage, open_models_are_viewed_as_open) {
    put_noise(31);
    ASSERT_EQ(run("reconstruct " + of("noise") + " --no-background --boundary open" + to_model()).code, 0);
    const std::string view = "view " + out("m.vtp") + " -o " + out("m.html");
    EXPECT_THAT(run(view + " --boundary open").out, HasSubstr("0 violations"));
    EXPECT_THAT(run(view).out, HasSubstr("violation open_edge"));
}

TEST_F(Usage, what_room_changed_is_not_said_to_keep_its_label) {
    put_noise(31);
    const Ran ran = run("reconstruct " + of("noise") + " --room 1" + to_model());
    EXPECT_THAT(ran.out, HasSubstr("changed the label within --room"));
    EXPECT_THAT(ran.out, HasSubstr("samples keeps its label, or the one that --room gave it"));
    EXPECT_EQ(run(reconstruct_ball()).out.find("--room"), std::string::npos);
}

TEST_F(Usage, one_thing_is_one_thing_and_lists_say_how_many_more) {
    ASSERT_EQ(run(reconstruct_ball()).code, 0);
    EXPECT_THAT(run("check " + out("m.vtp")).out, HasSubstr(": 1 region, "));
    EXPECT_THAT(run("view " + out("m.vtp") + " -o " + out("m.html")).out, HasSubstr(" 1 region, 0 violations"));
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    std::string apart = facet;
    for (std::size_t at = 0; (at = apart.find("vertex ", at)) != std::string::npos; at += 8) apart.insert(at + 7, "9");
    put_text(path("open.stl"), "solid a\n" + facet + apart + "endsolid a\n");
    EXPECT_THAT(run("check " + path("open.stl").string()).out,
                AllOf(HasSubstr("violation open_edge: 6\n"), HasSubstr("  and 3 more; --json lists them\n")));
}

}  // namespace
}  // namespace regionmesh
