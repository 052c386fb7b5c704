// The program as a user runs it: exit codes, one line on stderr, no file left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "cli/program.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"
#include "support/digest.h"
#include "support/labels.h"
#include "support/paths.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

using Ran = Program::Ran;

class Cli : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("volume.raw");
    }

    /// Arguments that read the volume of this test, a ball of 1 in 0.
    std::string volume() const { return ball("volume.raw"); }
};

TEST_F(Cli, reconstruct_writes_a_model_and_a_report) {
    const Ran ran = run("reconstruct " + volume() + "-o " + out("m.vtp") + " --reduce 50% --report " + out("r.json"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(ran.error, "");
    EXPECT_THAT(ran.out, HasSubstr("faces"));
    EXPECT_EQ(files_left(), 2);
    EXPECT_THAT(text_of(out("r.json")), HasSubstr("\"final_faces\""));
    const MeshFile file = read_mesh(out("m.vtp"));
    test::expect_sound(check(file.mesh));
}

TEST_F(Cli, names_of_a_table_go_to_the_model_and_the_report) {
    put_text(path("names.csv"), "label,name\n1,the ball\n");
    const std::string names = " --names " + path("names.csv").string();
    const Ran ran = run("reconstruct " + volume() + "-o " + out("m.vtp") + names + " --report " + out("r.json"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(read_mesh(out("m.vtp")).names, (LabelNames{{1, "the ball"}}));
    EXPECT_THAT(text_of(out("r.json")), HasSubstr("\"name\": \"the ball\""));
    const Ran smoothed = run("smooth " + out("m.vtp") + " -o " + out("s.ply"));
    EXPECT_EQ(smoothed.code, 0) << smoothed.error;
    EXPECT_EQ(read_mesh(out("s.ply")).names, (LabelNames{{1, "the ball"}}));
}

TEST_F(Cli, table_of_names_that_cannot_be_read_is_refused_before_the_work) {
    expect_refusal("reconstruct " + volume() + "-o " + out("m.vtp") + " --names " + path("none.csv").string(), 1,
                   "none.csv");
}

TEST_F(Cli, per_region_writes_a_file_for_each_region) {
    const Ran ran = run("reconstruct " + volume() + "-o " + out("m.stl") + " --no-background --per-region");
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(files_left(), 2);
    EXPECT_TRUE(std::filesystem::exists(out("m-0.stl")));
    EXPECT_TRUE(std::filesystem::exists(out("m-1.stl")));
}

TEST_F(Cli, single_precision_far_from_the_origin_is_a_warning) {
    const auto nrrd = [&](const std::string& origin) {
        put_text(path("far.nrrd"),
                 "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 9 9 9\nspace dimension: 3\n"
                 "space directions: (0.1,0,0) (0,0.1,0) (0,0,0.1)\nspace origin: " +
                     origin + "\nencoding: raw\n\n" + text_of(path("volume.raw")));
        return "reconstruct " + path("far.nrrd").string() + " -o " + out("m.stl");
    };
    EXPECT_THAT(run(nrrd("(1e5,0,0)") + " --per-region").error, HasSubstr("m.stl: its numbers of single precision"));
    EXPECT_THAT(run(nrrd("(1e5,0,0)")).error, HasSubstr("m.stl: its numbers of single precision"));
    EXPECT_EQ(run(nrrd("(1e5,0,0)") + " --ascii").error, "");
    EXPECT_EQ(run(nrrd("(100,0,0)") + " --per-region").error, "");
}

TEST_F(Cli, open_box_is_refused_where_volumes_are_needed) {
    expect_refusal("reconstruct " + volume() + "-o " + out("m.smesh") + " --boundary open", 1, "--boundary open");
}

TEST_F(Cli, a_face_budget_that_cannot_be_kept_is_said) {
    const auto said = [&](const std::string& budget) {
        return run("reconstruct " + volume() + "--target-faces 100 --face-budget " + budget + " -o " + out("m.vtp"))
            .out;
    };
    EXPECT_THAT(said("20"), HasSubstr("more than --face-budget 20: "));
    EXPECT_THAT(said("100000"), Not(HasSubstr("--face-budget")));
}

TEST_F(Cli, quiet_says_nothing) {
    const Ran ran = run("reconstruct " + volume() + "-o " + out("m.ply") + " --quiet");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out + ran.error, "");
}

TEST_F(Cli, written_models_pass_check_against_their_volume) {
    for (const std::string more : {"", "--no-background ", "--boundary open "}) {
        SCOPED_TRACE(more);
        EXPECT_EQ(run("reconstruct " + volume() + more + "-o " + out("m.vtp") + " --reduce 0.5").code, 0);
        const Ran ran =
            run("check " + out("m.vtp") + " " + more + "--sections " + volume() + " --json " + out("c.json"));
        EXPECT_EQ(ran.code, 0) << ran.out << ran.error;
        EXPECT_THAT(ran.out, HasSubstr("no violations"));
        // Regions of an open model have no inside: nothing is said of samples.
        EXPECT_THAT(ran.out, Not(HasSubstr("another region")));
    }
}

TEST_F(Cli, reconstruct_smooths_unless_told_not_to) {
    const std::string to = "reconstruct " + volume() + "--quiet -o ";
    EXPECT_EQ(run(to + out("default.vtp")).code, 0);
    EXPECT_EQ(run(to + out("lattice.vtp") + " --smooth-filter lattice").code, 0);
    EXPECT_EQ(run(to + out("taubin.vtp") + " --smooth-filter taubin").code, 0);
    EXPECT_EQ(run(to + out("twenty.vtp") + " --smooth 20 --smooth-filter taubin --smooth-lambda 0.6").code, 0);
    EXPECT_EQ(run(to + out("zero.vtp") + " --smooth 0").code, 0);
    EXPECT_EQ(run(to + out("none.vtp") + " --smooth-filter none").code, 0);
    const std::string smoothed = text_of(out("default.vtp")), plain = text_of(out("zero.vtp"));
    EXPECT_TRUE(text_of(out("lattice.vtp")) == smoothed);
    EXPECT_TRUE(text_of(out("twenty.vtp")) == text_of(out("taubin.vtp")));
    EXPECT_TRUE(text_of(out("none.vtp")) == plain);
    EXPECT_TRUE(smoothed != plain);
}

TEST_F(Cli, every_smoothing_option_leads_to_a_sound_model_of_its_own) {
    std::set<std::string> meshes;
    for (const std::string options :
         {"", "--smooth-filter taubin", "--smooth-filter taubin --smooth 3", "--smooth-filter laplacian",
          "--smooth-filter nifpms", "--smooth-filter taubin --smooth-lambda 0.3"}) {
        SCOPED_TRACE(options);
        EXPECT_EQ(run("reconstruct " + volume() + options + " -o " + out("m.vtp")).code, 0);
        EXPECT_EQ(run("check " + out("m.vtp") + " --sections " + volume()).code, 0);
        EXPECT_TRUE(meshes.insert(text_of(out("m.vtp"))).second) << "the same as without";
    }
}

TEST_F(Cli, the_report_of_decimate_says_what_became_of_the_edges) {
    ASSERT_EQ(run("reconstruct " + volume() + "-o " + out("full.ply") + " --no-decimate").code, 0);
    ASSERT_EQ(
        run("decimate " + out("full.ply") + " -o " + out("half.ply") + " --reduce 50% --report " + out("r.json")).code,
        0);
    const std::string report = text_of(out("r.json"));
    EXPECT_THAT(report, HasSubstr("\"stopped\": \"target\""));
    EXPECT_THAT(report, HasSubstr("\"decimate\": "));
    EXPECT_THAT(report, Not(HasSubstr("\"accepted\": 0,")));
    EXPECT_EQ(
        run("decimate " + out("full.ply") + " -o " + out("half2.ply") + " --reduce 50% --report /no/such/r.json").code,
        1);
    EXPECT_EQ(files_left(), 3) << "a report that cannot be written is found out before the work";
}

TEST_F(Cli, the_report_says_what_smoothing_did) {
    EXPECT_EQ(run("reconstruct " + volume() + "-o " + out("m.vtp") + " --report " + out("r.json")).code, 0);
    for (const char* said : {"\"smoothing\"", "\"vertices\"", "\"turned_faces\"", "\"crossing_pairs\"",
                             "\"stepped_back\"", "\"rms_displacement\"", "\"smooth\""})
        EXPECT_THAT(text_of(out("r.json")), HasSubstr(said));
}

TEST_F(Cli, smooth_takes_a_model_and_writes_the_same_without_steps) {
    EXPECT_EQ(
        run("reconstruct " + volume() + "--no-decimate --smooth 0 --cells tetrahedra -o " + out("steps.vtp")).code, 0);
    const Ran ran = run("smooth " + out("steps.vtp") + " -o " + out("m.vtp") + " --scale 1 --report " + out("r.json"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(ran.error, "");
    EXPECT_THAT(ran.out, HasSubstr("backtracked"));
    EXPECT_THAT(text_of(out("r.json")), HasSubstr("\"smoothing\""));
    EXPECT_EQ(run("check " + out("m.vtp") + " --sections " + volume()).code, 0);
    EXPECT_EQ(run("reconstruct " + volume() + "--no-decimate --smooth-filter taubin -o " + out("direct.vtp")).code, 0);
    EXPECT_EQ(test::surface_digest(read_mesh(out("m.vtp")).mesh),
              test::surface_digest(read_mesh(out("direct.vtp")).mesh));
}

TEST_F(Cli, smooth_may_write_over_what_it_read) {
    EXPECT_EQ(run("reconstruct " + volume() + "--no-background --smooth 0 -o " + out("m.ply")).code, 0);
    const std::string before = text_of(out("m.ply"));
    EXPECT_EQ(run("smooth " + out("m.ply") + " -o " + out("m.ply") + " --no-background --quiet").code, 0);
    EXPECT_TRUE(text_of(out("m.ply")) != before);
    EXPECT_EQ(run("check " + out("m.ply") + " --no-background --sections " + volume()).code, 0);
    EXPECT_EQ(files_left(), 1);
}

TEST_F(Cli, smooth_of_a_broken_model_is_exit_3) {
    Mesh mesh = test::octahedron();
    mesh.remove_face(FaceId{0});
    const LabelTable labels = test::labels_from({5, 7});
    write_mesh(mesh, labels, path("broken.vtp"), {});
    const Ran ran = run("smooth " + path("broken.vtp").string() + " -o " + out("m.vtp"));
    EXPECT_EQ(ran.code, 3);
    EXPECT_EQ(ran.error, "");
    EXPECT_THAT(ran.out, HasSubstr("6 violations (before 6)")) << "no better, no worse";
}

TEST_F(Cli, bad_smoothing_is_refused) {
    const std::string to = "-o " + out("m.vtp");
    for (const std::string lambda : {"2", "-0.5", "much", "nan"})
        expect_refusal("reconstruct " + volume() + to + " --smooth-lambda " + lambda, 2, "--smooth-lambda");
    for (const std::string passes : {"-1", "many", "2.5", "99999999999"})
        expect_refusal("reconstruct " + volume() + to + " --smooth " + passes, 2, "--smooth " + passes);
    expect_refusal("reconstruct " + volume() + to + " --smooth-filter gaussian", 2, "--smooth-filter");
    expect_refusal("smooth " + path("nothing.vtp").string() + " " + to, 1, "nothing.vtp");
    expect_refusal("smooth " + path("volume.raw").string() + " " + to, 1, "volume.raw");
    expect_refusal("smooth " + path("nothing.vtp").string(), 2, "--output");
    const LabelTable labels = test::labels_from({5, 7});
    write_mesh(test::octahedron(), labels, path("good.vtp"), {});
    expect_refusal("smooth " + path("good.vtp").string() + " -o " + out("m.xyz"), 1, "m.xyz");
    expect_refusal("smooth " + path("good.vtp").string() + " " + to + " --smooth-lambda 1.01", 2, "--smooth-lambda");
    expect_refusal("smooth " + path("good.vtp").string() + " " + to + " --smooth-filter lattice", 2, "use taubin");
    expect_refusal("smooth " + path("good.vtp").string() + " " + to + " --scale big", 2, "--scale");
    expect_refusal("smooth " + path("good.vtp").string() + " " + to + " --min-quality good", 2, "--min-quality");
}

TEST_F(Cli, layer_chooses_among_layers_and_info_prints_names) {
    const std::string layers = data("nrrd/layers_first_uint8.seg.nrrd");
    expect_refusal("info " + layers, 1, "give --layer 0 to --layer 1");
    const Ran ran = run("info " + layers + " --layer 1");
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("101  1 sample  high\n"));
    EXPECT_THAT(ran.out, Not(HasSubstr("next")));
    expect_refusal("info " + layers + " --layer x", 2, "--layer x");
}

TEST_F(Cli, info_prints_what_a_volume_is) {
    const Ran ran = run("info " + volume() + "--spacing 1,2,5");
    EXPECT_EQ(ran.code, 0) << ran.error;
    for (const char* said : {"9 x 9 x 9", "1 x 2 x 5", "uint8", "labels     2", "faces unsimplified"})
        EXPECT_THAT(ran.out, HasSubstr(said));
}

TEST_F(Cli, bad_input_is_exit_1) {
    const std::string to = " -o " + out("m.vtp");
    expect_refusal("reconstruct " + path("nothing.npy").string() + to, 1, "nothing.npy");
    expect_refusal("info " + path("nothing.npy").string(), 1, "nothing.npy");
    put_text(path("words.txt"), "no volume");
    expect_refusal("reconstruct " + path("words.txt").string() + to, 1, "words.txt");
    put_text(path("empty.npy"), "");
    expect_refusal("reconstruct " + path("empty.npy").string() + to, 1, "empty.npy");
    expect_refusal("reconstruct " + data("npy/bad/empty.npy") + to, 1, "empty.npy");
    expect_refusal("reconstruct " + data("npy/bad/complex64.npy") + to, 1, "complex64.npy");
    expect_refusal("reconstruct " + path("volume.raw").string() + " --size 9,9,10 --type uint8" + to, 1, "volume.raw");
    expect_refusal("check " + path("nothing.vtp").string(), 1, "nothing.vtp");
}

TEST_F(Cli, an_empty_folder_is_exit_1) {
    std::filesystem::create_directory(path("sections"));
    expect_refusal("reconstruct " + path("sections").string() + " -o " + out("m.vtp"), 1, "sections");
}

TEST_F(Cli, bad_values_are_exit_2) {
    const std::string to = "-o " + out("m.vtp");
    expect_refusal("reconstruct " + volume() + to + " --target-faces many", 2, "many");
    expect_refusal("reconstruct " + volume() + to + " --target-faces -5", 2, "target-faces");
    expect_refusal("reconstruct " + volume() + to + " --reduce 150%", 2, "150%");
    expect_refusal("reconstruct " + volume() + to + " --max-error x", 2, "max-error");
    expect_refusal("reconstruct " + volume() + to + " --memory 1", 1, "--memory");
    expect_refusal("reconstruct " + volume() + to + " --memory 3quarts", 2, "3quarts");
    expect_refusal("reconstruct " + volume() + to + " --spacing 1,2", 2, "--spacing");
    expect_refusal("reconstruct " + volume() + to + " --spacing 1,0,1", 2, "--spacing");
    expect_refusal("reconstruct " + volume() + to + " --background -x", 2, "background");
    expect_refusal("reconstruct " + path("volume.raw").string() + " --size 9,9 --type uint8 " + to, 2, "--size");
}

TEST_F(Cli, bad_usage_is_exit_2) {
    const std::string to = "-o " + out("m.vtp");
    expect_refusal("", 2, "regionmesh");
    expect_refusal("dance", 2, "regionmesh");
    expect_refusal("reconstruct", 2, "regionmesh");
    expect_refusal("reconstruct " + volume(), 2, "--output");
    expect_refusal("reconstruct " + volume() + to + " --sweep w", 2, "sweep");
    expect_refusal("reconstruct " + volume() + to + " --no-such-flag", 2, "no-such-flag");
}

TEST_F(Cli, an_output_that_cannot_be_written_is_refused_and_leaves_nothing) {
    for (const std::string& to : {out("m.xyz"), out("m"), out("none/m.vtp"), path("volume.raw").string() + "/m.vtp"}) {
        SCOPED_TRACE(to);
        const Ran ran = run("reconstruct " + volume() + "-o " + to);
        EXPECT_TRUE(ran.code == 1 || ran.code == 2) << ran.code;
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
        EXPECT_EQ(files_left(), 0);
    }
}

TEST_F(Cli, a_full_disk_is_one_line_and_leaves_nothing) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    std::filesystem::create_symlink("/dev/full", path("full.vtp"));
    const Ran ran = run("reconstruct " + volume() + "-o " + path("full.vtp").string());
    // The model may be written beside the link and take its place; if it goes through the link the disk is full.
    if (ran.code == 0) return;
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
}

TEST_F(Cli, a_file_size_limit_is_one_line_and_leaves_nothing) {
    const std::string command = "trap '' XFSZ; ulimit -f 2; '" + test::program() + "' reconstruct " + volume() + "-o " +
                                out("m.vtp") + " 2>'" + path("stderr").string() + "' >'" + path("stdout").string() +
                                "'";
    const int status = std::system(("bash -c \"" + command + "\"").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_EQ(std::ranges::count(text_of(path("stderr")), '\n'), 1) << text_of(path("stderr"));
    EXPECT_EQ(files_left(), 0);
}

TEST_F(Cli, check_of_a_broken_model_is_exit_3) {
    Mesh mesh = test::octahedron();
    mesh.remove_face(FaceId{0});
    const LabelTable labels = test::labels_from({5, 7});
    write_mesh(mesh, labels, path("broken.vtp"), {});
    const Ran ran = run("check " + path("broken.vtp").string() + " --json " + path("c.json").string());
    EXPECT_EQ(ran.code, 3);
    EXPECT_EQ(ran.error, "");
    EXPECT_THAT(ran.out, HasSubstr("open_edge"));
    EXPECT_THAT(ran.out, Not(HasSubstr("no violations")));
    EXPECT_THAT(text_of(path("c.json")), HasSubstr("open_edge"));
    EXPECT_EQ(run("check --quiet " + path("broken.vtp").string()).code, 3);
}

TEST_F(Cli, check_of_a_good_model_is_exit_0) {
    const LabelTable labels = test::labels_from({5, 7});
    write_mesh(test::octahedron(), labels, path("good.ply"), {});
    EXPECT_EQ(run("check " + path("good.ply").string()).code, 0);
}

TEST_F(Cli, check_finds_that_a_model_is_of_another_volume) {
    EXPECT_EQ(run("reconstruct " + volume() + "-o " + out("m.vtp")).code, 0);
    std::string labels = text_of(path("volume.raw"));
    labels[4 * 81 + 4 * 9 + 4] = 2;
    put_text(path("volume.raw"), labels);
    const Ran ran = run("check " + out("m.vtp") + " --sections " + volume());
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.out, HasSubstr("euler"));
}

TEST_F(Cli, decimate_keeps_what_is_broken_and_says_so) {
    EXPECT_EQ(
        run("reconstruct " + volume() + "--no-background --smooth 0 --no-decimate -o " + path("whole.vtp").string())
            .code,
        0);
    MeshFile file = read_mesh(path("whole.vtp"));
    const std::uint32_t faces = file.mesh.face_count();
    file.mesh.remove_face(FaceId{faces / 2});
    write_mesh(file.mesh, file.labels, path("cracked.vtp"), {});
    const std::string options = " --no-background --reduce 60% -o " + out("m.vtp");
    const Ran ran = run("decimate " + path("cracked.vtp").string() + options);
    EXPECT_EQ(ran.code, 3) << ran.error;
    EXPECT_EQ(ran.error, "");
    EXPECT_THAT(ran.out,
                HasSubstr("3 vertices and 0 faces not changed, because of violations in the input: open_edge"));
    EXPECT_THAT(ran.out, Not(HasSubstr("more violations")));
    EXPECT_LE(read_mesh(out("m.vtp")).mesh.face_count(), 2 * faces / 5);
    EXPECT_EQ(run("decimate " + path("whole.vtp").string() + options).code, 0);
}

TEST_F(Cli, convert_brings_regions_together_and_other_commands_read_them) {
    const std::string regions = data("surfaces/regions");
    const Ran ran = run("convert " + regions + " " + out("m.vtp"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("22 faces, 12 vertices"));
    EXPECT_EQ(run("convert " + out("m.vtp") + " " + out("m.ply") + " --quiet").out, "");
    EXPECT_EQ(run("check " + out("m.ply")).code, 0);
    EXPECT_EQ(run("check " + regions).code, 0);
    if (readable_extensions().find(".dream3d") != std::string::npos) {
        EXPECT_EQ(run("decimate " + data("surfaces/dream3d_8.dream3d") + " --reduce 10% -o " + out("d.vtp")).code, 0);
    }
    EXPECT_EQ(run("smooth " + data("surfaces/vtk_quads.vtp") + " -o " + out("s.vtp")).code, 0);
}

TEST_F(Cli, orient_turns_faces_and_check_says_where_they_are) {
    put_text(path("m.obj"),
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng interface_3_-1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n");
    const std::string mesh = path("m.obj").string();
    const Ran ran = run("check " + mesh + " --json " + out("c.json"));
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.out, HasSubstr("its two faces pass it in the same direction at (1, 0, 0)"));
    EXPECT_THAT(ran.out, HasSubstr("--orient"));
    for (const char* said : {"\"at\": [", "\"labels\": ["}) EXPECT_THAT(text_of(out("c.json")), HasSubstr(said));
    EXPECT_EQ(run("check --orient " + mesh).code, 0);
}

TEST_F(Cli, convert_refuses_what_it_cannot_use) {
    const std::string good = data("surfaces/vtk.obj");
    expect_refusal("convert " + path("nothing.stl").string() + " " + out("m.vtp"), 1, "nothing.stl");
    expect_refusal("convert " + good + " " + out("m.doc"), 1, "m.doc");
    expect_refusal("convert " + good + " " + out("none/m.vtp"), 1, "m.vtp");
    expect_refusal("convert " + good + " " + out("m.vtp") + " --weld near", 2, "--weld");
    expect_refusal("convert " + data("surfaces") + "/none " + out("m.vtp"), 1, "use one of .vtp");
    expect_refusal("convert " + data("nifti") + " " + out("m.vtp"), 1, "holds no surfaces");
    expect_refusal("convert " + good, 2, "required");
}

TEST_F(Cli, compare_prints_a_table_and_writes_all_figures) {
    EXPECT_EQ(run("reconstruct " + volume() + "-o " + path("a.vtp").string()).code, 0);
    EXPECT_EQ(run("reconstruct " + volume() + "-o " + path("b.ply").string() + " --reduce 50%").code, 0);
    const std::string both = path("a.vtp").string() + " " + path("b.ply").string();
    const Ran ran = run("compare " + both + " --samples 5000 --json " + out("c.json") + " --distance " + out("d.vtp"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(ran.error, "");
    for (const char* said : {"A to B", "B to A", "regions", "interfaces", "lines", "quality", "angles", "0|1"})
        EXPECT_THAT(ran.out, HasSubstr(said));
    EXPECT_THAT(text_of(out("c.json")), HasSubstr("\"quantile_95\""));
    EXPECT_THAT(text_of(out("d.vtp")), HasSubstr("Name=\"Distance\""));
    EXPECT_EQ(read_mesh(out("d.vtp")).mesh.face_count(), read_mesh(path("a.vtp")).mesh.face_count());
    EXPECT_EQ(files_left(), 2);
    const Ran quiet = run("compare " + both + " --samples 5000 --quiet --threads 8 --json " + out("e.json"));
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.error, "");
    EXPECT_EQ(text_of(out("e.json")), text_of(out("c.json")));
}

TEST_F(Cli, compare_warns_where_models_name_a_label_differently) {
    const LabelTable labels = test::labels_from({5, 7});
    const auto write = [&](const char* name, const LabelNames& names) {
        write_mesh(test::octahedron(), labels, path(name), {.names = names});
        return " " + path(name).string();
    };
    const std::string soil = write("soil.vtp", {{5, "soil"}, {7, "sand"}}), chalk = write("chalk.vtp", {{5, "chalk"}}),
                      bare = write("bare.vtp", {});
    const Ran other = run("compare" + soil + chalk);
    EXPECT_EQ(other.code, 0);
    EXPECT_THAT(other.error, HasSubstr("1 label under other names in A and B (5 is soil in A and chalk in B)"));
    EXPECT_EQ(run("compare" + soil + soil).error, "");
    EXPECT_EQ(run("compare" + soil + bare).error, "");
}

TEST_F(Cli, other_units_are_worth_a_warning) {
    const auto sections = [&](const char* name, const std::string& unit) {
        put_text(path(name),
                 "NRRD0004\ntype: uint8\ndimension: 3\nspace dimension: 3\nsizes: 2 2 2\nspace directions: (1,0,0) "
                 "(0,1,0) (0,0,1)\n" +
                     unit + "encoding: ascii\n\n1 1 1 1 2 2 2 2\n");
        return " " + path(name).string();
    };
    const std::string mm = sections("mm.nrrd", "space units: \"mm\" \"mm\" \"mm\"\n"),
                      m = sections("m.nrrd", "space units: \"m\" \"m\" \"m\"\n"), none = sections("none.nrrd", "");
    ASSERT_EQ(run("reconstruct" + mm + " -o " + out("mm.vtp")).code, 0);
    ASSERT_EQ(run("reconstruct" + m + " -o " + out("m.vtp")).code, 0);
    ASSERT_EQ(run("reconstruct" + mm + " --block-size 2 -o " + out("folder")).code, 0);
    for (const std::string& use : {"compare " + out("m.vtp") + ' ', "check " + out("m.vtp") + " --sections",
                                   "voxelise " + out("m.vtp") + " -o " + out("v.nrrd") + " --like"}) {
        const bool is_compare = use.starts_with("compare");
        const Ran other = run(use + (is_compare ? out("mm.vtp") : mm));
        EXPECT_EQ(other.code, 0) << other.error;
        EXPECT_THAT(other.error, testing::ContainsRegex("m.vtp is in m and .*mm.(vtp|nrrd) in mm: they are compared"));
        EXPECT_EQ(run(use + (is_compare ? out("m.vtp") : m)).error, "");
        if (!is_compare) {
            EXPECT_EQ(run(use + none).error, "");
        }
    }
    EXPECT_THAT(run("check " + out("folder") + " --sections" + m).error, HasSubstr(" in m: they are compared"));
    EXPECT_THAT(run("info " + out("v.nrrd")).out, HasSubstr("spacing    1 x 1 x 1 m\n")) << "that of the model";
}

TEST_F(Cli, compare_refuses_what_it_cannot_use) {
    const LabelTable labels = test::labels_from({5, 7});
    write_mesh(test::octahedron(), labels, path("good.vtp"), {});
    write_mesh(Mesh(), labels, path("empty.vtp"), {});
    const std::string good = path("good.vtp").string();
    EXPECT_EQ(run("compare " + good + " " + good).code, 0);
    expect_refusal("compare " + good, 2, "regionmesh");
    expect_refusal("compare " + good + " " + path("nothing.vtp").string(), 1, "nothing.vtp");
    expect_refusal("compare " + good + " " + path("empty.vtp").string(), 1, "empty.vtp: has no faces");
    Mesh cap;
    test::add_shape(cap, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, 0, exterior(0)}});
    write_mesh(cap, labels, path("cap.vtp"), {});
    EXPECT_EQ(run("compare " + good + " " + path("cap.vtp").string()).code, 0);
    expect_refusal("compare " + good + " " + path("cap.vtp").string() + " --background 5", 1, "cap.vtp");
    expect_refusal("compare " + good + " " + good + " --samples 0", 2, "--samples 0");
    expect_refusal("compare " + good + " " + good + " --samples few", 2, "few");
    expect_refusal("compare " + good + " " + good + " --distance " + out("d.ply"), 1, "d.ply");
    expect_refusal("compare " + good + " " + good + " --json " + out("none/c.json"), 1, "c.json");
    expect_refusal("compare " + good + " " + good + " --background x", 2, "background");
}

TEST_F(Cli, help_and_version_are_exit_0) {
    EXPECT_THAT(run("--help").out, HasSubstr("reconstruct"));
    EXPECT_EQ(run("--help").code, 0);
    EXPECT_EQ(run("reconstruct --help").code, 0);
    EXPECT_EQ(run("--version").code, 0);
}

}  // namespace
}  // namespace regionmesh
