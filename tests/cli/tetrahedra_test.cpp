// Points, drill holes and meshes of tetrahedra as a user reads them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "cli/program.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"
#include "support/digest.h"
#include "support/paths.h"
#include "support/random.h"

namespace regionmesh {
namespace {

using Ran = Program::Ran;
using testing::HasSubstr;
using testing::Not;

std::string numbers(Vec3 p) { return std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z); }

class CliTetrahedra : public Program {
protected:
    /// Any points, but no two at one place.
    std::string table(const std::string& name, const std::string& head, int count,
                      const std::function<std::string(Vec3)>& label) const {
        test::Random random(7);
        std::string text = head + "\n";
        for (int n = 0; n < count; ++n) {
            const Vec3 p = random.point(5);
            text += numbers(p) + "," + label(p) + "\n";
        }
        put_text(path(name), text);
        return path(name).string();
    }
    /// Layers from 1 up.
    std::string layers(InputLabel first = 1) const {
        return table("points.csv", "x,y,z,label", 250,
                     [=](Vec3 p) { return std::to_string(first + (p.z > p.x / 4) + (p.z > 2)); });
    }
    std::string words() const {
        return table("words.csv", "x,y,z,lith", 250, [](Vec3 p) { return p.z > p.x / 4 ? "\"grès, dur\"" : "clay"; });
    }
    std::string holes() const {
        std::string text = "hole,x,y,surface,from,to,lith\n";
        test::Random random(9);
        for (int n = 0; n < 15; ++n) {
            const double x = random.between(0, 100), y = random.between(0, 100), a = 10 + x / 10, b = 25 + y / 20;
            const std::string hole = "H" + std::to_string(n) + "," + std::to_string(x) + "," + std::to_string(y) + "," +
                                     std::to_string(50 + x / 9) + ",";
            text += hole + "0," + std::to_string(a) + ",soil\n" + hole + std::to_string(a) + "," + std::to_string(b) +
                    ",sand\n" + hole + std::to_string(b) + ",40,rock\n";
        }
        put_text(path("holes.csv"), text);
        return path("holes.csv").string() + " --step 4";
    }

    void expect_sound_way(const std::string& input, const std::string& more = "") const {
        for (const std::string options :
             {"--no-decimate --smooth 0", "--no-decimate", "--reduce 60%", "--reduce 60% --smooth-filter laplacian"}) {
            SCOPED_TRACE(input + " " + options + more);
            const Ran made = run("reconstruct " + input + " " + options + more + " -o " + out("m.vtp"));
            EXPECT_EQ(made.code, 0) << made.out << made.error;
            EXPECT_EQ(made.error, "");
            const Ran checked = run("check " + out("m.vtp") + more + " --sections " + input);
            EXPECT_EQ(checked.code, 0) << checked.out << checked.error;
            EXPECT_THAT(checked.out, HasSubstr("no violations"));
        }
    }
};

/// Those that need the program which makes tetrahedra of points.
class CliPoints : public CliTetrahedra {
protected:
    void SetUp() override {
        if (test::delaunay_program().empty()) GTEST_SKIP() << "built without regionmesh-delaunay";
        CliTetrahedra::SetUp();
    }
};

TEST_F(CliPoints, points_become_models_that_pass_check_against_their_table) {
    expect_sound_way(layers());
    expect_sound_way(words());
    expect_sound_way(layers(-1), " --no-background");
}

TEST_F(CliPoints, holes_become_models_that_pass_check_against_their_table) {
    expect_sound_way(holes());
    expect_sound_way(holes() + " --scale-z 3");
}

TEST_F(CliPoints, models_have_the_unit_of_their_table) {
    std::string text = text_of(layers().c_str());
    text.replace(0, 5, "x (ft),y (ft),z (ft)");
    put_text(path("feet.csv"), text);
    const std::string feet = path("feet.csv").string();
    const Ran shown = run("info " + feet + " --json " + out("i.json"));
    EXPECT_THAT(shown.out, HasSubstr(" ft (mean)\n"));
    EXPECT_THAT(text_of(out("i.json")), HasSubstr("\"unit\": \"ft\""));
    ASSERT_EQ(run("reconstruct " + feet + " -o " + out("m.vtp")).code, 0);
    EXPECT_THAT(run("info " + out("m.vtp")).out, testing::ContainsRegex("\nbox  .* ft\n"));
    ASSERT_EQ(run("convert " + out("m.vtp") + ' ' + out("m.glb")).code, 0);
    EXPECT_THAT(text_of(out("m.glb")), HasSubstr("\"scale\":[0.3048,0.3048,0.3048]"));
    ASSERT_EQ(run("reconstruct " + feet + " --units m -o " + out("m.vtp")).code, 0);
    EXPECT_THAT(run("info " + out("m.vtp")).out, testing::ContainsRegex("\nbox  .* m\n"));
}

TEST_F(CliTetrahedra, meshes_become_models_that_pass_check_against_them) {
    for (const std::string name : {"meshio_ascii.vtu", "vtk_points.vtu", "vtk_raw_zlib_64.vtu",
                                   "gmsh_41_ascii_volumes.msh", "gmsh_22_binary.msh"})
        expect_sound_way(data("meshes/" + name), " --no-background");
}

TEST_F(CliPoints, models_with_background_or_open_boundary_pass_check_when_read_again) {
    expect_sound_way(layers(0));
    expect_sound_way(layers(), " --boundary open");
}

TEST_F(CliPoints, background_is_label_0_unless_told) {
    const std::string table = layers(0);
    const auto regions = [&](const std::string& more) {
        const Ran ran = run("reconstruct " + table + more + " -o " + out("m.vtp"));
        EXPECT_EQ(ran.code, 0) << ran.out << ran.error;
        return ran.out;
    };
    EXPECT_THAT(regions(""), HasSubstr("2 regions, "));
    EXPECT_THAT(regions(" --no-background"), HasSubstr("3 regions, "));
    EXPECT_THAT(regions(" --background 1 --background 2"), HasSubstr("1 region, "));
    EXPECT_THAT(regions(" --background 7"), HasSubstr("3 regions, "));
}

TEST_F(CliPoints, words_are_names_in_the_model_the_report_and_info) {
    const std::string table = words();
    const Ran ran = run("reconstruct " + table + " -o " + out("m.vtp") + " --report " + out("r.json"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(read_mesh(out("m.vtp")).names, (LabelNames{{1, "clay"}, {2, "grès, dur"}}));
    EXPECT_THAT(text_of(out("r.json")), HasSubstr("\"name\": \"grès, dur\""));
    const Ran info = run("info " + table);
    EXPECT_EQ(info.code, 0) << info.error;
    for (const char* said : {"250 points", "(csv)", "labels     2", "clay", "grès, dur", "faces unsimplified"})
        EXPECT_THAT(info.out, HasSubstr(said));
}

TEST_F(CliTetrahedra, info_of_a_mesh_counts_what_has_the_labels) {
    const Ran cells = run("info " + data("meshes/meshio_ascii.vtu"));
    EXPECT_EQ(cells.code, 0) << cells.error;
    for (const char* said :
         {"12 points, 12 tetrahedra", "(vtu)", "spacing    1 (mean)", "labels     2", "6 tetrahedra"})
        EXPECT_THAT(cells.out, HasSubstr(said));
    EXPECT_THAT(run("info " + data("meshes/vtk_points.vtu")).out, HasSubstr("4 points"));
}

TEST_F(CliPoints, repeated_points_with_different_labels_name_both_rows) {
    const std::string table = layers();
    std::string text = text_of(table);
    const std::string first = text.substr(text.find('\n') + 1);
    const std::string place = first.substr(0, first.find('\n')), same = place.substr(0, place.rfind(','));
    put_text(table, text + same + ",88\n");
    const std::string to = "reconstruct " + table + " -o " + out("m.vtp");
    expect_refusal(to, 1, "row 2 and row 252 ");
    expect_refusal(to, 1, " 88: ");
    put_text(table, text + place + "\n");
    EXPECT_EQ(run(to).code, 0) << "with one label they are one point";
}

TEST_F(CliPoints, sweeps_and_threads_make_sound_models) {
    const std::string table = layers();
    for (const std::string sweep : {"x", "y", "z", "auto"}) {
        const Ran ran =
            run("reconstruct " + table + " --sweep " + sweep + " --threads 3 --reduce 50% -o " + out("m.vtp"));
        EXPECT_EQ(ran.code, 0) << ran.out << ran.error;
        EXPECT_EQ(run("check " + out("m.vtp") + " --sections " + table).code, 0);
    }
}

TEST_F(CliPoints, hull_says_aloud_what_is_the_rule) {
    const std::string table = layers();
    EXPECT_EQ(run("reconstruct " + table + " -o " + out("a.vtp")).code, 0);
    EXPECT_EQ(run("reconstruct " + table + " --hull -o " + out("b.vtp")).code, 0);
    EXPECT_EQ(run("reconstruct " + table + " --boundary open -o " + out("c.vtp")).code, 0);
    EXPECT_TRUE(text_of(out("a.vtp")) == text_of(out("b.vtp")));
    EXPECT_TRUE(text_of(out("a.vtp")) != text_of(out("c.vtp")));
}

TEST_F(CliTetrahedra, drill_holes_become_layers) {
    const std::string table = holes().substr(0, holes().find(' ')), read = " --layers auto --spacing 5,5,1";
    for (const std::string options : {" --no-decimate --smooth off", " --reduce 60%"}) {
        const Ran made = run("reconstruct " + table + read + options + " -o " + out("m.vtp"));
        EXPECT_EQ(made.code, 0) << made.error;
        const Ran checked = run("check " + out("m.vtp") + " --sections " + table + read);
        EXPECT_EQ(checked.code, 0) << checked.out << checked.error;
        EXPECT_THAT(checked.out, HasSubstr("no violations"));
        EXPECT_THAT(checked.out, HasSubstr("keeps its label"));
    }
    const Ran shown = run("info " + table + read);
    EXPECT_THAT(shown.out, HasSubstr("3 from young to old: soil, sand, rock; 100.0 % of the logged length"));
    std::filesystem::remove(out("m.vtp"));
    expect_refusal("reconstruct " + table + read + " --step 4 -o " + out("m.vtp"), 2, "--layers and --step");
    expect_refusal("info " + table + " --terrain ground.asc", 2,
                   "--terrain ground.asc: applies to drill holes as layers");
    expect_refusal("info " + table + " --surveys s.csv", 2, "give --collars, too");
    expect_refusal("info " + layers() + " --layers auto", 1, "is a table of points");
    expect_refusal("info " + data("meshes/meshio_ascii.vtu") + " --layers auto", 2, "--layers auto: does not apply");
}

TEST_F(CliTetrahedra, the_scale_of_drill_holes_is_estimated) {
    const Ran shown = run("info " + holes() + " --scale-z auto --json " + out("i.json"));
    EXPECT_EQ(shown.code, 0) << shown.error;
    EXPECT_THAT(text_of(out("i.json")), HasSubstr("\"scale_z\": 4")) << "holes 15 m apart, points 3.5 m";
    std::filesystem::remove(out("i.json"));
    expect_refusal("info " + layers() + " --scale-z auto", 1, "--scale-z auto is for drill holes");
}

TEST_F(CliTetrahedra, options_of_the_other_kind_of_input_are_refused) {
    const std::string mesh = data("meshes/meshio_ascii.vtu"), table = layers(), to = " -o " + out("m.vtp");
    put_text(path("volume.raw"), std::string(27, '\1'));
    const std::string volume = path("volume.raw").string() + " --size 3,3,3 --type uint8";
    for (const std::string& input : {mesh, table}) {
        expect_refusal("reconstruct " + input + to + " --hull --boundary open", 2, "--hull");
        expect_refusal("reconstruct " + input + to + " --spacing 1,1,2", 2, "--spacing 1,1,2");
        expect_refusal("reconstruct " + input + to + " --size 3,3,3", 2, "--size");
        expect_refusal("reconstruct " + input + to + " --type uint8", 2, "--type");
        expect_refusal("reconstruct " + input + to + " --scale-z 0", 2, "--scale-z 0");
        expect_refusal("reconstruct " + input + to + " --scale-z -1", 2, "--scale-z -1");
        expect_refusal("reconstruct " + input + to + " --scale-z inf", 2, "--scale-z inf");
        expect_refusal("reconstruct " + input + " " + table + to, 2, "points.csv: one table or mesh at a time");
        expect_refusal("info " + input + " --spacing 1", 2, "--spacing");
    }
    for (const std::string option : {"--columns 1,2,3,4", "--step 1", "--array label", "--hull"})
        expect_refusal("reconstruct " + volume + to + " " + option, 2, option.substr(0, option.find(' ')));
    expect_refusal("reconstruct " + volume + " " + table + to, 2, "one");
}

TEST_F(CliTetrahedra, options_of_tables_are_refused_for_meshes_and_of_meshes_for_tables) {
    const std::string mesh = data("meshes/meshio_ascii.vtu"), to = " -o " + out("m.vtp");
    expect_refusal("reconstruct " + mesh + to + " --columns 1,2,3,4", 2, "--columns");
    expect_refusal("reconstruct " + mesh + to + " --step 1", 2, "--step");
    expect_refusal("reconstruct " + layers() + to + " --array label", 2, "--array");
    expect_refusal("reconstruct " + layers() + to + " --step 1", 1, "--step");
}

TEST_F(CliTetrahedra, what_cannot_be_read_is_one_line) {
    const std::string to = " -o " + out("m.vtp");
    put_text(path("bad.vtu"), "<VTKFile>");
    put_text(path("bad.msh"), "$MeshFormat\n");
    put_text(path("bad.csv"), "x,y,z,label\n0,0,0,1\n1,0,zero,1\n");
    for (const std::string name : {"bad.vtu", "bad.msh", "bad.csv", "none.csv", "none.vtu", "none.msh"})
        expect_refusal("reconstruct " + path(name).string() + to, 1, name);
    expect_refusal("reconstruct " + data("meshes/meshio_ascii.vtu") + to + " --array none", 1, "'none'");
    expect_refusal("check " + path("none.vtp").string() + " --sections " + path("none.csv").string(), 1, "none.");
}

TEST_F(CliTetrahedra, folder_for_temporary_files_that_is_not_there_is_named) {
    expect_refusal("reconstruct " + data("meshes/meshio_ascii.vtu") + " -o " + out("m.vtp"), 1, "TMPDIR",
                   "TMPDIR=" + path("nowhere").string());
}

TEST_F(CliPoints, too_few_points_and_points_in_a_plane_are_refused) {
    const auto refused = [&](const std::string& rows, const std::string& said) {
        put_text(path("few.csv"), "x,y,z,label\n" + rows);
        expect_refusal("reconstruct " + path("few.csv").string() + " -o " + out("m.vtp"), 1, said);
    };
    refused("", "few.csv");
    refused("0,0,0,1\n1,0,0,2\n0,1,0,3\n", "at least four");
    refused("0,0,0,1\n1,0,0,2\n0,1,0,3\n1,1,0,1\n2,5,0,1\n", "one plane");
    put_text(path("few.csv"), "x,y,z,label\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n");
    EXPECT_EQ(run("reconstruct " + path("few.csv").string() + " -o " + out("m.vtp")).code, 0);
}

}  // namespace
}  // namespace regionmesh
