// What models say about themselves in files: background, space, units, names; and what the shell gets.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "cli/program.h"
#include "regionmesh/blocks.h"
#include "regionmesh/check.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class CliFiles : public Program {
protected:
    /// Four regions round a point, one of them `empty`, in a ball of the label `around`, in the space RAS.
    std::string volume(int empty = 4, int around = 0, const std::string& space = "right-anterior-superior") const {
        std::string text = "NRRD0004\ntype: short\ndimension: 3\nsizes: 14 14 14\nspace: " + space +
                           "\nspace directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (5,6,7)\nencoding: ascii\n\n";
        for (int z = 0; z < 14; ++z)
            for (int y = 0; y < 14; ++y)
                for (int x = 0; x < 14; ++x) {
                    const double dx = x - 6.3, dy = y - 6.6, dz = z - 6.4;
                    int label = dz > 1 ? 1 : dx > 0 ? 2 : dy > 0 ? 3 : 4;
                    if (label == 4) label = empty;
                    if (dx * dx + dy * dy + dz * dz > 30 && z > 3) label = around;
                    text += std::to_string(label) + (x == 13 ? "\n" : " ");
                }
        put_text(path("v.nrrd"), text);
        return path("v.nrrd").string() + ' ';
    }
    void expect_good(const std::string& arguments) const {
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, 0) << arguments << '\n' << ran.out << ran.error;
    }
    std::string read(const std::string& file) const { return text_of(out(file)); }
};

TEST_F(CliFiles, the_background_is_kept_in_the_model) {
    const std::string labels = volume(4, 9);
    for (const std::string name : {"m.vtp", "m.vtu", "m.ply", "m.obj"}) {
        SCOPED_TRACE(name);
        expect_good("reconstruct " + labels + "-o " + out(name) + " --background 9");
        EXPECT_THAT(read_mesh(out(name)).background.value(), ElementsAre(9));
        expect_good("check " + out(name));
        expect_good("check " + out(name) + " --sections " + labels);
        expect_good("convert " + out(name) + ' ' + out("m.stl") + " --ascii");
        EXPECT_THAT(read("m.stl"), HasSubstr("solid region_4"));
        EXPECT_THAT(read("m.stl"), Not(HasSubstr("region_9")));
    }
    EXPECT_EQ(run("check " + out("m.vtp") + " --background 0").code, 3);  // the command line decides
}

TEST_F(CliFiles, a_model_without_background_says_so) {
    for (const std::string name : {"m.vtp", "m.ply", "m.obj"}) {
        SCOPED_TRACE(name);
        expect_good("reconstruct " + volume() + "-o " + out(name) + " --no-background");
        EXPECT_THAT(read_mesh(out(name)).background.value(), ElementsAre());
        expect_good("convert " + out(name) + ' ' + out("m.stl") + " --ascii");
        EXPECT_THAT(read("m.stl"), HasSubstr("solid region_0"));
        expect_good("reconstruct " + volume(4, 9) + "-o " + out(name) + " --no-background");
        EXPECT_THAT(read_mesh(out(name)).background.value(), ElementsAre()) << "and no region has label 0";
    }
}

TEST_F(CliFiles, oblique_models_of_all_formats_are_closed_and_keep_their_box) {
    const std::string labels = volume(4, 9);
    put_text(path("v.nrrd"), std::regex_replace(text_of(path("v.nrrd")), std::regex("directions: [^\n]*"),
                                                "directions: (0.8,0.6,0) (-0.6,0.8,0) (0,0,2)"));
    const double whole = 13 * 13 * 26;
    for (const std::string name : {"m.vtp", "m.ply", "m.obj", "m.stl"}) {
        SCOPED_TRACE(name);
        for (const std::string background : {"--background 9", "--no-background"}) {
            expect_good("reconstruct " + labels + "-o " + out(name) + ' ' + background);
            expect_good("check " + out(name) + ' ' + background);
            expect_good("check " + out(name) + " --sections " + labels + background);
            expect_good("smooth " + out(name) + " -o " + out("s.vtp") + ' ' + background);
            expect_good("decimate " + out(name) + " --reduce 95% -o " + out("d.vtp") + ' ' + background);
            if (background == "--background 9") continue;
            for (const char* changed : {"s.vtp", "d.vtp"}) {
                const MeshFile model = read_mesh(out(changed));
                double sum = 0;
                for (const RegionReport& region : check(model.mesh).regions) sum += region.volume;
                EXPECT_NEAR(sum, whole, 1e-6 * whole) << changed;
            }
        }
    }
    expect_good("reconstruct " + labels + "-o " + out("o.vtp") + " --boundary open");
    expect_good("check " + out("o.vtp") + " --boundary open");
    expect_good("decimate " + out("o.vtp") + " -o " + out("d.vtp") + " --boundary open --reduce 50%");
    expect_good("reconstruct " + labels + "-o " + out("m.vtp"));
    expect_good("convert " + out("m.vtp") + ' ' + out("c.vtp"));
    EXPECT_EQ(read("m.vtp"), read("c.vtp"));
}

TEST_F(CliFiles, faces_that_may_cross_are_found_in_the_end) {
    const test::ArrayVolume noise = test::noise_volume({5, 4, 5}, 2, 1);
    put_text(path("n.raw"), {noise.labels().begin(), noise.labels().end()});
    const std::string from = path("n.raw").string() + " --type uint8 --size 5,4,5 ";
    const Ran ran =
        run("reconstruct " + from +
            "--no-background --smooth off --reduce 95% --no-keep-samples --no-intersect-check -o " + out("m.vtp"));
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.out, HasSubstr("crossing_faces"));
}

TEST_F(CliFiles, stl_and_back_agrees_with_the_volume) {
    const std::string labels = volume(0);  // quadruple points between three regions and the background
    expect_good("reconstruct " + labels + "-o " + out("m.stl"));
    const Ran ran = run("check " + out("m.stl") + " --sections " + labels);
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_THAT(ran.out, HasSubstr("every one of 2,744 samples keeps its label"));
}

TEST_F(CliFiles, stl_of_a_region_with_the_label_of_the_exterior_agrees_with_the_volume) {
    for (const int label : {-1, -3}) {
        const std::string labels = volume(label);
        expect_good("reconstruct " + labels + "-o " + out("m.stl"));
        EXPECT_THAT(read("m.stl"), HasSubstr("solid region_" + std::to_string(label)));
        expect_good("check " + out("m.stl"));
        const Ran ran = run("check " + out("m.stl") + " --sections " + labels);
        EXPECT_EQ(ran.code, 0) << ran.out << ran.error;
        EXPECT_THAT(ran.out, HasSubstr("every one of 2,744 samples keeps its label"));
    }
}

TEST_F(CliFiles, models_say_their_space_as_slicer_reads_it) {
    const std::string labels = volume();
    for (const std::string name : {"m.vtp", "m.vtu", "m.ply", "m.obj", "m.stl"}) {
        SCOPED_TRACE(name);
        expect_good("reconstruct " + labels + "-o " + out(name));
        EXPECT_EQ(read_mesh(out(name)).coordinates.space, Space::kRas);
        const bool is_vtk = name == "m.vtp" || name == "m.vtu";
        EXPECT_THAT(read(name), HasSubstr(is_vtk ? "Name=\"SPACE\"" : "SPACE=RAS"));
        EXPECT_THAT(read_mesh(out(name)).names, testing::IsEmpty());
        expect_good("convert " + out(name) + " --space lps " + out("turned.ply"));
        const MeshFile there = read_mesh(out("turned.ply")), here = read_mesh(out(name));
        EXPECT_EQ(there.coordinates.space, Space::kLps);
        const Vec3 p = here.mesh.position(VertexId{0}), q = there.mesh.position(VertexId{0});
        EXPECT_EQ(q, (Vec3{-p.x, -p.y, p.z}));
        if (name != "m.stl") expect_good("check " + out("turned.ply") + " --sections " + labels);
    }
    expect_good("reconstruct " + labels + "--block-size 9 -o " + out("pieces"));
    expect_good("convert " + out("pieces") + " --space lps " + out("turned.ply"));
    const MeshFile pieces = read_block_folder(out("pieces")), turned = read_mesh(out("turned.ply"));
    EXPECT_EQ(turned.coordinates.space, Space::kLps);
    const Vec3 p = pieces.mesh.position(VertexId{0});
    EXPECT_EQ(turned.mesh.position(VertexId{0}), (Vec3{-p.x, -p.y, p.z}));
    EXPECT_THAT(run("compare " + out("pieces") + ' ' + out("turned.ply")).error, HasSubstr("is in RAS and "));
    expect_good("reconstruct " + labels + "-o " + out("lps.ply") + " --space lps");
    expect_good("check " + out("lps.ply") + " --sections " + labels);
    expect_good("reconstruct " + volume(4, 0, "left-posterior-superior") + "-o " + out("other.ply"));
    EXPECT_EQ(read_mesh(out("other.ply")).coordinates.space, Space::kLps);
}

TEST_F(CliFiles, vtk_colours_by_region) {
    expect_good("reconstruct " + volume() + "-o " + out("m.vtp"));
    const std::string text = read("m.vtp");
    EXPECT_THAT(text, HasSubstr("<CellData Scalars=\"Region\">"));
    EXPECT_THAT(text, HasSubstr("Name=\"Region\" NumberOfComponents=\"1\""));
    EXPECT_THAT(text, HasSubstr("Name=\"Neighbour\" NumberOfComponents=\"1\""));
}

TEST_F(CliFiles, files_of_regions_have_their_names_and_are_listed) {
    put_text(path("names.csv"), "label,name\n1,Left lung\n2,left lung\n");
    const Ran ran =
        run("reconstruct " + volume() + "-o " + out("m.stl") + " --per-region --names " + path("names.csv").string());
    EXPECT_EQ(ran.code, 0) << ran.error;
    for (const char* name : {"m-Left_lung.stl", "m-left_lung_2.stl", "m-3.stl", "m-4.stl"}) {
        EXPECT_TRUE(std::filesystem::exists(out(name))) << name;
        EXPECT_THAT(ran.out, HasSubstr(out(name) + "\n"));
    }
    EXPECT_EQ(files_left(), 4);
    EXPECT_THAT(read("m-3.stl").substr(0, 80), HasSubstr("SPACE=RAS"));
}

TEST_F(CliFiles, the_table_of_regions_has_their_measures) {
    // A box of 2 x 2 x 2 samples in the middle of another region; without smoothing its half-way surface is known.
    std::string text = "NRRD0004\ntype: short\ndimension: 3\nsizes: 6 6 6\nencoding: ascii\n\n";
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 6; ++x)
                text += std::max({std::abs(x - 2.5), std::abs(y - 2.5), std::abs(z - 2.5)}) < 1 ? "7 " : "5 ";
    put_text(path("box.nrrd"), text);
    put_text(path("names.csv"), "label,name\n5,\"a, b\"\n");
    expect_good("reconstruct " + path("box.nrrd").string() + " -o " + out("m.vtp") + " --smooth off --regions " +
                out("r.csv") + " --names " + path("names.csv").string());
    const std::string table = read("r.csv");
    EXPECT_THAT(table, HasSubstr("label,name,faces,volume,area,"));
    EXPECT_THAT(table, HasSubstr("\n5,\"a, b\","));
    const MeshFile file = read_mesh(out("m.vtp"));
    double volume = 0;
    for (std::uint32_t f = 0; f < file.mesh.face_count(); ++f) {
        const auto& face = file.mesh[FaceId{f}];
        for (const int side : {0, 1})
            if (!is_exterior(face.labels[side]) && file.labels.input(face.labels[side]) == 7) {
                const auto [a, b, c] = file.mesh.corners(FaceId{f});
                volume += (side == 0 ? 1 : -1) * dot(a, cross(b, c)) / 6;
            }
    }
    const std::string row = table.substr(table.find("\n7,") + 1);
    std::vector<std::string> fields(1);
    for (const char c : row.substr(0, row.find('\n')))
        if (c == ',')
            fields.emplace_back();
        else
            fields.back() += c;
    ASSERT_EQ(fields.size(), 19u);
    EXPECT_NEAR(std::stod(fields[3]), volume, 1e-9);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(std::stod(fields[5 + axis]), 2.5, 1e-9);  // centroid
        EXPECT_NEAR(std::stod(fields[8 + axis]), 1.5, 1e-9);  // box
        EXPECT_NEAR(std::stod(fields[11 + axis]), 3.5, 1e-9);
    }
    EXPECT_NEAR(std::stod(fields[14]), std::cbrt(6 * volume / M_PI), 1e-8);
    EXPECT_EQ(fields[15], "5");
    EXPECT_EQ(fields[16], fields[4]);  // its whole surface is the interface
}

TEST_F(CliFiles, units_scale_glb_to_metres) {
    expect_good("reconstruct " + volume() + "-o " + out("m.glb") + " --units mm");
    EXPECT_THAT(read("m.glb"), HasSubstr("\"scale\":[0.001,0.001,0.001]"));
    expect_good("reconstruct " + volume() + "-o " + out("m.glb"));
    EXPECT_THAT(read("m.glb"), Not(HasSubstr("\"scale\"")));
}

TEST_F(CliFiles, the_unit_of_a_volume_is_that_of_its_models) {
    std::string labels = text_of(volume().substr(0, volume().size() - 1));
    labels.insert(labels.find("encoding"), "space units: \"um\" \"um\" \"um\"\n");
    put_text(path("v.nrrd"), labels);
    const std::string input = path("v.nrrd").string() + ' ', scaled = "\"scale\":[1e-06,1e-06,1e-06]";
    expect_good("reconstruct " + input + "-o " + out("m.glb"));
    EXPECT_THAT(read("m.glb"), HasSubstr(scaled));
    expect_good("reconstruct " + input + "-o " + out("m.vtp") + " --html " + out("m.html"));
    EXPECT_THAT(read("m.html"), HasSubstr("\"unit\":\"um\""));
    for (const std::string name : {"m.ply", "m.obj", "m.vtu"}) {
        expect_good("decimate " + out("m.vtp") + " --reduce 20% -o " + out(name));
        expect_good("convert " + out(name) + ' ' + out("m.glb"));
        EXPECT_THAT(read("m.glb"), HasSubstr(scaled)) << name;
    }
    expect_good("convert " + out("m.vtp") + ' ' + out("m.glb") + " --units mm");
    EXPECT_THAT(read("m.glb"), HasSubstr("\"scale\":[0.001,0.001,0.001]"));
    EXPECT_THAT(run("info " + input).out, HasSubstr("spacing    1 x 1 x 2 um\n"));
    EXPECT_THAT(run("info " + out("m.vtp")).out, HasSubstr(" um\n"));
    expect_good("convert " + out("m.vtp") + ' ' + out("mm.vtp") + " --units mm");
    EXPECT_THAT(run("compare " + out("m.vtp") + ' ' + out("mm.vtp")).error, HasSubstr("m.vtp is in um and "));
    expect_good("view " + out("mm.vtp") + " -o " + out("v.html"));
    EXPECT_THAT(read("v.html"), HasSubstr("\"unit\":\"mm\""));
    expect_good("reconstruct " + input + "--block-size 9 -o " + out("pieces"));
    EXPECT_EQ(read_block_folder(out("pieces")).coordinates, (Coordinates{Space::kRas, 1e-6, Vec3{1, 1, 2}}));
}

TEST_F(CliFiles, decimation_knows_the_spacing_that_a_model_says) {
    std::string labels = text_of(volume().substr(0, volume().size() - 1));
    labels.replace(labels.find("(0,0,2)"), 7, "(0,0,8)");
    put_text(path("v.nrrd"), labels);
    const auto bound = [&](const std::string& model) {
        expect_good("reconstruct " + path("v.nrrd").string() + " -o " + out(model));
        expect_good("decimate " + out(model) + " --reduce 50% -o " + out("d.vtp") + " --report " + out("r.json"));
        return nlohmann::json::parse(read("r.json")).at("quality_bound").get<double>();
    };
    EXPECT_EQ(bound("m.vtp"), 0.1 / 8);
    EXPECT_EQ(bound("m.ply"), 0.1 / 8);
    EXPECT_EQ(bound("m.stl"), 0.1) << "which does not say it";
    const std::string page = " --html " + out("m.html");
    expect_good("decimate " + out("m.vtp") + " --reduce 50% -o " + out("d.vtp") + page);
    EXPECT_THAT(read("m.html"), HasSubstr("\"min_quality\":0.0125,"));
    expect_good("decimate " + out("m.vtp") + " --improve -o " + out("d.vtp") + page + " --report " + out("r.json"));
    EXPECT_THAT(read("m.html"), HasSubstr("\"min_quality\":null,"));
    EXPECT_FALSE(nlohmann::json::parse(read("r.json")).contains("quality_bound")) << "nothing was decimated";
    expect_good("decimate " + out("m.vtp") + " --smooth-lines -o " + out("d.vtp"));
}

TEST_F(CliFiles, smoothed_models_have_a_page) {
    expect_good("reconstruct " + volume() + "--smooth off -o " + out("m.vtp"));
    expect_good("smooth " + out("m.vtp") + " --smooth 5 -o " + out("s.vtp") + " --html " + out("s.html"));
    const std::string page = read("s.html");
    EXPECT_THAT(page, HasSubstr("\"command_line\":\"regionmesh smooth "));
    EXPECT_THAT(page, HasSubstr("\"title\":\"s.vtp\""));
    EXPECT_THAT(page, HasSubstr("largest_displacement"));
}

TEST_F(CliFiles, a_part_of_a_volume_is_checked_against_the_same_part) {
    const std::string part = " --roi 2:12,:,3: --labels 1-3 --downsample 2,2,1 --min-region 3";
    expect_good("reconstruct " + volume() + "-o " + out("m.vtp") + part);
    expect_good("check " + out("m.vtp") + " --sections " + volume() + part);
    EXPECT_EQ(run("check " + out("m.vtp") + " --sections " + volume()).code, 3);
    EXPECT_THAT(run("info " + volume() + part).out, HasSubstr("5 x 7 x 11 samples"));
    put_text(path("merge.csv"), "old,new,name\n1-3,8,inside\n");
    EXPECT_THAT(run("info " + volume() + "--merge " + path("merge.csv").string()).out, HasSubstr("inside"));
    std::filesystem::remove(out("m.vtp"));
    expect_refusal("reconstruct " + volume() + "-o " + out("m.vtp") + " --roi 0:99,:,:", 1, "is not within the 14");
    for (const char* bad :
         {"--roi 1:2", "--roi 5:5,:,:", "--labels 1,,2", "--labels 3-", "--labels 5-3",
          "--labels 18446744073709551615-3", "--downsample 0", "--box 3:1,:,:", "--labels 1 --no-background"})
        expect_refusal("reconstruct " + volume() + "-o " + out("m.vtp") + ' ' + bad, 2, "--");
}

TEST_F(CliFiles, a_model_of_cleaned_labels_is_checked_against_them) {
    const std::string labels = volume(), checked = "check " + out("m.vtp") + " --sections " + labels;
    expect_good("reconstruct " + labels + "-o " + out("m.vtp") + " --room 1.5");
    EXPECT_THAT(run(checked).out, HasSubstr("samples lie in another region"));
    EXPECT_THAT(run(checked + "--room 1.5").out,
                AllOf(HasSubstr("no violations"), HasSubstr("every one of 2,744 samples keeps its label")));
    EXPECT_EQ(run("reconstruct " + labels + "--block-size 8 -o " + out("pieces") + "/ --room 1.5").code, 0);
    EXPECT_THAT(run("check " + out("pieces") + " --room 1.5 --sections " + labels).out,
                HasSubstr("every one of 2,744 samples keeps its label"));
}

TEST_F(CliFiles, a_bad_row_of_a_table_beside_the_volume_is_a_warning) {
    const std::string labels = volume();
    put_text(path("v.csv"), "label,name\n1,top\n3x,left\n");
    const Ran ran = run("info " + labels);
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.error, AllOf(HasSubstr("warning: "), HasSubstr("v.csv: row 3: '3x' is no label")));
    put_text(path("v.csv"), "A note on the volume,\nwith 2 lines\n");
    EXPECT_EQ(run("info " + labels).error, "");
}

TEST_F(CliFiles, a_word_among_the_labels_of_holes_is_a_warning) {
    std::string rows = "x,y,from,to,unit\n";
    for (const std::string at : {"0,0", "9,0", "0,9", "9,8"}) rows += at + ",0,4,1\n" + at + ",4,9,sand\n";
    put_text(path("holes.csv"), rows);
    for (const std::string options : {"", " --layers auto"}) {
        const Ran ran = run("info " + path("holes.csv").string() + options);
        EXPECT_EQ(ran.code, 0) << ran.error;
        EXPECT_THAT(ran.error,
                    AllOf(HasSubstr("warning: "), HasSubstr("label '1' is a whole number and 'sand' is none")));
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
    }
}

TEST_F(CliFiles, the_manual_page_and_completions_have_every_option) {
    const std::string manual = run("--help-man").out;
    std::string all[] = {run("--completion bash").out, run("--completion zsh").out, run("--completion fish").out};
    for (const OptionSpec& option : option_table()) {
        if (option.is_argument) continue;
        std::string escaped = option.name;
        for (std::size_t at = 0; (at = escaped.find('-', at)) != std::string::npos; at += 2)
            escaped.insert(at, 1, '\\');
        EXPECT_THAT(manual, HasSubstr("\\-\\-" + escaped + "\\fR"));
        EXPECT_THAT(all[0], HasSubstr(option.flag()));
        EXPECT_THAT(all[1], HasSubstr(option.flag() + "["));
        EXPECT_THAT(all[2], HasSubstr("-l " + option.name));
    }
    put_text(path("c.bash"), all[0] +
                                 "COMP_WORDS=(regionmesh check --quie)\nCOMP_CWORD=2\n_regionmesh\n"
                                 "echo \"${COMPREPLY[*]}\"\nCOMP_WORDS=(regionmesh comp)\nCOMP_CWORD=1\n_regionmesh\n"
                                 "echo \"${COMPREPLY[*]}\"\ntouch 'a file.nii'\n"
                                 "COMP_WORDS=(regionmesh info a)\nCOMP_CWORD=2\n_regionmesh\n"
                                 "printf '<%s>\\n' \"${COMPREPLY[@]}\"\n");
    ASSERT_EQ(std::system(("mkdir '" + path("here").string() + "' && cd '" + path("here").string() + "' && bash '" +
                           path("c.bash").string() + "' >'" + path("words").string() + "'")
                              .c_str()),
              0);
    EXPECT_EQ(text_of(path("words")), "--quiet\ncompare\n<a file.nii>\n");
    EXPECT_EQ(run("--completion csh").code, 2);
}

TEST_F(CliFiles, tables_of_interfaces_and_lines_are_written_with_the_model_or_the_check) {
    const std::string labels = volume();
    expect_good("reconstruct " + labels + "-o " + out("m.vtp") + " --interfaces " + out("i.csv") + " --lines " +
                out("l.csv"));
    EXPECT_THAT(read("i.csv"), HasSubstr("\n1,2,"));
    EXPECT_THAT(read("l.csv"), HasSubstr("\n1 2 3,"));
    expect_good("check " + out("m.vtp") + " --interfaces " + out("j.csv") + " --lines " + out("k.csv"));
    EXPECT_EQ(read("i.csv"), read("j.csv"));
    EXPECT_EQ(read("l.csv"), read("k.csv"));
    EXPECT_EQ(run("check " + out("m.vtp") + " --interfaces " + out("same.csv") + " --lines " + out("same.csv")).code,
              2);
}

TEST_F(CliFiles, colours_of_a_table_go_into_models_and_on) {
    const std::string labels = volume(4);
    put_text(path("v.ctbl"), "0 background 0 0 0 0\n4 the_fourth 255 128 0 255\n");  // beside v.nrrd
    for (const std::string name : {"m.vtp", "m.ply", "m.obj"}) {
        SCOPED_TRACE(name);
        expect_good("reconstruct " + labels + "-o " + out(name));
        EXPECT_EQ(read_mesh(out(name)).colours.at(4), 0xFF8000u);
        expect_good("convert " + out(name) + ' ' + out("n.vtu"));
        EXPECT_EQ(read_mesh(out("n.vtu")).colours.at(4), 0xFF8000u);
        put_text(path("other.csv"), "label,name,color\n4,x,#0000ff\n");
        expect_good("convert " + out(name) + ' ' + out("n.obj") + " --names " + path("other.csv").string());
        EXPECT_THAT(read("n.mtl"), HasSubstr("newmtl x\nKd 0 0 1\n"));
    }
    expect_good("view " + out("m.vtp") + " -o " + path("p.html").string());
    EXPECT_THAT(text_of(path("p.html")), HasSubstr("#ff8000"));
    expect_good("smooth " + out("m.vtp") + " -o " + out("s.vtp"));
    EXPECT_EQ(read_mesh(out("s.vtp")).colours.at(4), 0xFF8000u);
}

}  // namespace
}  // namespace regionmesh
