// Folders of pieces, as a user makes them: killed runs, several processes, and what is refused.
#include "regionmesh/blocks.h"

#include <signal.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "blocks/folder_lock.h"
#include "cli/program.h"
#include "formats/vtk/vtk_numbers.h"
#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"
#include "support/random.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class BlockProgram : public Program {
protected:
    /// Arguments that reconstruct grains of 40 samples along each axis into a folder.
    std::string grains(const std::string& folder) const {
        const fs::path file = path("grains.raw");
        if (!fs::exists(file)) {
            const test::ArrayVolume volume = test::grain_volume({40, 40, 40}, 20, 5);
            put_text(file, {volume.labels().begin(), volume.labels().end()});
        }
        return "reconstruct " + file.string() +
               " --size 40,40,40 --type uint8 --smooth light --reduce 75% --block-size 14 -o " + out(folder);
    }

    std::map<std::string, std::string> files_in(const std::string& folder) const {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::directory_iterator(out(folder)))
            files[entry.path().filename().string()] = text_of(entry.path());
        return files;
    }

    /// Number of calls of a run that can fail.
    std::uint64_t calls_of(const std::string& arguments) const {
        const std::string counts = path("counts").string();
        EXPECT_EQ(run(arguments, counted("REGIONMESH_FAULT_COUNT='" + counts + '\'')).code, 0);
        return std::stoull(text_of(counts));
    }
    /// Runs the program, killed at its n-th call that can fail; whether it made as many.
    bool run_and_kill(const std::string& arguments, std::uint64_t call) const {
        constexpr int kKilled = 128 + SIGKILL;  // of a shell; -1: the shell became the program
        const int code =
            run(arguments, counted("REGIONMESH_FAULT=kill REGIONMESH_FAULT_AT=" + std::to_string(call))).code;
        return code == -1 || code == kKilled;
    }

private:
    /// Variables that put the library before the program that counts its calls.
    static std::string counted(const std::string& more) { return "LD_PRELOAD='" + test::shim() + "' " + more; }
};

TEST_F(BlockProgram, goes_on_after_twenty_kills_and_leaves_the_same_bytes) {
    if (test::shim().empty()) GTEST_SKIP() << "sanitizers let nothing be put before their allocator";
    const std::uint64_t calls = calls_of(grains("whole"));
    test::Random random(20);
    int kills = 0;
    for (int n = 0; n < 20; ++n)
        kills += run_and_kill(grains("killed"), static_cast<std::uint64_t>(calls * random.between(0.02, 0.2)));
    EXPECT_GE(kills, 5) << "the run was complete too early, with " << calls << " calls";
    const Ran last = run(grains("killed"));
    ASSERT_EQ(last.code, 0) << last.error;
    EXPECT_THAT(last.out, testing::HasSubstr("in 64 pieces of up to 14 cells"));
    EXPECT_EQ(files_in("killed"), files_in("whole"));
}

TEST_F(BlockProgram, converts_checks_and_voxelises_a_folder) {
    ASSERT_EQ(run(grains("model")).code, 0);
    const std::string sections = " --sections " + path("grains.raw").string() + " --size 40,40,40 --type uint8";
    const Ran checked = run("check " + out("model") + sections);
    EXPECT_EQ(checked.code, 0) << checked.error;
    EXPECT_THAT(checked.out, testing::HasSubstr("every one of 64,000 samples keeps its label"));
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("a.vtp")).code, 0);
    ASSERT_EQ(run("convert " + out("model/") + ' ' + out("b.vtp")).code, 0);
    EXPECT_EQ(text_of(out("a.vtp")), text_of(out("b.vtp")));
    const std::string like = " --like" + sections.substr(sections.find(' ', 1));
    for (const char* from : {"model", "a.vtp"}) {  // the first piece by piece
        const Ran voxelised = run("voxelise " + out(from) + like + " -o " + out(std::string(from) + ".raw"));
        ASSERT_EQ(voxelised.code, 0) << voxelised.error;
        EXPECT_EQ(text_of(out(std::string(from) + ".raw")), text_of(path("grains.raw")));
    }
    EXPECT_THAT(run("info " + out("model")).out, testing::HasSubstr("faces"));
    const Ran compared = run("compare " + out("model") + ' ' + out("a.vtp") + " --samples 1000");
    EXPECT_EQ(compared.code, 0) << compared.error;
}

/// The same keys and values; numbers up to the rounding of sums.
void expect_same(const nlohmann::json& a, const nlohmann::json& b, const std::string& where) {
    ASSERT_EQ(a.type(), b.type()) << where;
    ASSERT_EQ(a.size(), b.size()) << where;
    if (a.is_object())
        for (const auto& [key, value] : a.items()) {
            ASSERT_TRUE(b.contains(key)) << where << ' ' << key;
            expect_same(value, b[key], where + '/' + key);
        }
    else if (a.is_array())
        for (std::size_t n = 0; n < a.size(); ++n) expect_same(a[n], b[n], where + '/' + std::to_string(n));
    else if (a.is_number_float())
        EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-10 * std::abs(a.get<double>())) << where;
    else
        EXPECT_EQ(a, b) << where;
}

TEST_F(BlockProgram, the_report_on_a_folder_is_that_on_the_model_in_one_file) {
    ASSERT_EQ(run(grains("model")).code, 0);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("whole.vtp")).code, 0);
    const std::string sections = " --sections " + path("grains.raw").string() + " --size 40,40,40 --type uint8";
    for (const std::string& options : {std::string(), sections}) {
        for (const char* model : {"model", "whole.vtp"})
            ASSERT_EQ(run("check " + out(model) + " --json " + out(std::string(model) + ".json") + options).code, 0);
        auto whole = nlohmann::json::parse(text_of(out("whole.vtp.json")));
        EXPECT_EQ(whole.erase("shapes"), 1u) << "docs/reference/report.md: missing for a folder";
        expect_same(whole, nlohmann::json::parse(text_of(out("model.json"))), "");
        EXPECT_EQ(whole.at("regions").size(), 19u);
    }
}

TEST_F(BlockProgram, info_on_a_folder_is_that_on_the_model_in_one_file) {
    ASSERT_EQ(run(grains("model")).code, 0);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("whole.vtp")).code, 0);
    std::vector<nlohmann::json> found;
    std::vector<std::string> tables;
    for (const char* model : {"model", "whole.vtp"}) {
        const Ran ran = run("info " + out(model) + " --json " + out("info.json"));
        ASSERT_EQ(ran.code, 0) << ran.error;
        tables.push_back(ran.out.substr(ran.out.find("size")));
        found.push_back(nlohmann::json::parse(text_of(out("info.json"))));
        found.back().erase("file");
    }
    EXPECT_EQ(tables[0], tables[1]);
    EXPECT_EQ(found[0].at("regions").size(), 19u);
    expect_same(found[0], found[1], "");

    const auto files = files_in("model");
    const auto piece = std::ranges::find_if(files, [](const auto& file) { return file.first.ends_with(".piece"); });
    std::string damaged = piece->second;
    damaged[damaged.size() / 2] ^= 1;
    put_text(fs::path(out("model")) / piece->first, damaged);
    const Ran refused = run("info " + out("model"));
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.error, testing::HasSubstr(piece->first + ": the checksum does not fit"));
}

TEST_F(BlockProgram, a_folder_is_compared_piece_by_piece_or_joined_for_distances) {
    ASSERT_EQ(run(grains("model")).code, 0);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("whole.vtp")).code, 0);
    const std::string options = " --samples 5000 --json " + out("c.json");
    for (const std::string& more : {std::string(), " --distance " + out("d.vtp"), " --html " + out("page.html")}) {
        const Ran ran = run("compare " + out("model") + ' ' + out("whole.vtp") + options + more);
        ASSERT_EQ(ran.code, 0) << ran.error;
        const auto report = nlohmann::json::parse(text_of(out("c.json")));
        EXPECT_EQ(report.at("distance").at("both").at("max"), 0);
        EXPECT_EQ(report.at("faces").at("a"), report.at("faces").at("b"));
        EXPECT_EQ(report.at("vertices").at("a"), report.at("vertices").at("b"));
    }
    EXPECT_EQ(read_mesh(out("d.vtp")).mesh.face_count(), read_mesh(out("whole.vtp")).mesh.face_count());
}

/// The numbers in a point array of a .vtp file.
std::vector<std::int64_t> point_numbers(const fs::path& path, const char* name) {
    const formats::VtkXml xml(path, "PolyData");
    const pugi::xml_node points = xml.dataset().child("Piece").child("PointData");
    EXPECT_STREQ(points.attribute(name).value(), name);
    formats::VtkNumbers numbers(xml, points.find_child_by_attribute("Name", name), std::nullopt);
    std::vector<std::int64_t> found;
    while (!numbers.at_end()) found.push_back(numbers.integer());
    return found;
}

TEST_F(BlockProgram, pieces_for_paraview_number_the_vertices_of_the_whole) {
    ASSERT_EQ(run(grains("model")).code, 0);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("m.pvtp")).code, 0);
    const MeshFile whole = read_block_folder(out("model"));
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path("out")))
        if (entry.path().extension() == ".vtp") files.insert(entry.path());
    std::int64_t next = 0;
    std::uint64_t points = 0;
    for (const fs::path& file : files) {
        const std::vector<std::int64_t> ids = point_numbers(file, "GlobalIds");
        const Mesh mesh = std::move(read_mesh(file).mesh);
        ASSERT_EQ(ids.size(), mesh.vertex_count());
        points += ids.size();
        for (std::uint32_t v = 0; v < ids.size(); ++v) {
            ASSERT_LE(ids[v], next) << "a number was left out";
            next = std::max(next, ids[v] + 1);
            ASSERT_EQ(mesh.position(VertexId{v}), whole.mesh.position(VertexId{static_cast<std::uint32_t>(ids[v])}));
        }
    }
    EXPECT_EQ(next, whole.mesh.vertex_count());
    const auto manifest = nlohmann::json::parse(text_of(fs::path(out("model")) / "manifest.json"));
    EXPECT_EQ(next, manifest.at("vertices").get<std::int64_t>());
    EXPECT_GT(points, whole.mesh.vertex_count() + 1000) << "vertices on seams are in several pieces";
    EXPECT_THAT(text_of(out("m.pvtp")), testing::HasSubstr("<PPointData GlobalIds=\"GlobalIds\">"));
}

TEST_F(BlockProgram, a_region_has_one_colour_in_all_pieces) {
    ASSERT_EQ(run(grains("model")).code, 0);
    for (const char* output : {"m.pvtp", "whole.vtp"})
        ASSERT_EQ(run("convert " + out("model") + ' ' + out(output)).code, 0);
    std::map<std::int64_t, std::set<std::array<std::int64_t, 3>>> colours;  // by region
    for (const auto& entry : fs::directory_iterator(path("out"))) {
        if (entry.path().extension() != ".vtp") continue;
        const formats::VtkXml xml(entry.path(), "PolyData");
        const pugi::xml_node cells = xml.dataset().child("Piece").child("CellData");
        formats::VtkNumbers regions(xml, cells.find_child_by_attribute("Name", "Region"), std::nullopt),
            rgb(xml, cells.find_child_by_attribute("Name", "RGB"), std::nullopt);
        while (!regions.at_end()) {
            const std::int64_t red = rgb.integer(), green = rgb.integer(), blue = rgb.integer();
            colours[regions.integer()].insert({red, green, blue});
        }
    }
    EXPECT_GE(colours.size(), 18u);
    for (const auto& [region, seen] : colours) EXPECT_EQ(seen.size(), 1u) << region;
}

TEST_F(BlockProgram, converts_a_folder_piece_by_piece_for_paraview) {
    ASSERT_EQ(run(grains("model")).code, 0);
    const Ran ran = run("convert " + out("model") + ' ' + out("m.pvtp"));
    ASSERT_EQ(ran.code, 0) << ran.error;
    const MeshFile whole = read_block_folder(out("model"));
    const std::string list = text_of(out("m.pvtp"));
    std::uint64_t faces = 0, files = 0;
    for (const auto& entry : fs::directory_iterator(path("out"))) {
        if (entry.path().extension() != ".vtp") continue;
        EXPECT_THAT(list, testing::HasSubstr("<Piece Source=\"" + entry.path().filename().string() + "\"/>"));
        faces += read_mesh(entry.path()).mesh.face_count();
        ++files;
    }
    EXPECT_EQ(faces, whole.mesh.face_count());
    EXPECT_EQ(files, 64u);
}

/// The numbers of a file.
template <class T>
std::vector<T> numbers_in(std::string_view text) {
    std::vector<T> numbers(text.size() / sizeof(T));
    std::memcpy(numbers.data(), text.data(), numbers.size() * sizeof(T));
    return numbers;
}

TEST_F(BlockProgram, options_of_whole_models_are_refused_for_pieces) {
    ASSERT_EQ(run(grains("model")).code, 0);
    const auto refused = [&](const std::string& output, const std::string& said) {
        const Ran ran = run("convert " + out("model") + ' ' + out(output));
        EXPECT_EQ(ran.code, 2) << output;
        EXPECT_THAT(ran.error, testing::HasSubstr(said));
        EXPECT_EQ(files_left(), 1) << "the folder alone";
    };
    for (const std::string option : {"--regions r.csv", "--interfaces r.csv", "--lines r.csv", "--per-region",
                                     "--background 3", "--no-background", "--orient", "--space ras"})
        refused("m.pvtp " + option, option.substr(0, option.find(' ')) + ": is not for ");
    refused("m.vtp --weld 0.1", "--weld: the pieces of ");
    for (const std::string command : {"check ", "voxelise "})
        for (const std::string option : {" --weld 0", " --orient"}) {
            const std::string rest = command == "check " ? ""
                                                         : " --like " + path("grains.raw").string() +
                                                               " --size 40,40,40 --type uint8 -o " + out("v.npy");
            const Ran ran = run(command + out("model") + rest + option);
            EXPECT_EQ(ran.code, 2) << command << option;
            EXPECT_THAT(ran.error, testing::HasSubstr(": the pieces of "));
        }
    EXPECT_EQ(files_left(), 1) << "the folder alone";
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("'a&b.pvtp'")).code, 0);
    EXPECT_THAT(text_of(out("a&b.pvtp")), testing::HasSubstr("<Piece Source=\"a&amp;b-"));
}

TEST_F(BlockProgram, commands_that_write_no_folder_for_neuroglancer_leave_none) {
    grains("");  // writes grains.raw
    const std::string model = out("m.vtp"), volume = path("grains.raw").string() + " --size 40,40,40 --type uint8";
    ASSERT_EQ(run("reconstruct " + volume + " --reduce 90% -o " + model).code, 0);
    for (const std::string command : {"decimate", "smooth", "view"}) {
        EXPECT_NE(run(command + ' ' + model + " -o " + out("m.precomputed")).code, 0) << command;
        EXPECT_FALSE(fs::exists(out("m.precomputed"))) << command;
    }
}

TEST_F(BlockProgram, a_folder_for_neuroglancer_is_scaled_by_the_unit_that_the_input_says) {
    std::string labels =
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 8\nspacings: 1 1 1\n"
        "units: \"um\" \"um\" \"um\"\nencoding: raw\n\n";
    for (int n = 0; n < 512; ++n) labels += static_cast<char>(1 + n / 256);
    put_text(path("um.nrrd"), labels);
    ASSERT_EQ(run("reconstruct " + path("um.nrrd").string() + " --block-size 5 -o " + out("model")).code, 0);
    const auto converted = [&](const std::string& model, const std::string& options) {
        const fs::path folder = out("m.precomputed");
        fs::remove_all(folder);
        EXPECT_EQ(run("convert " + out(model) + ' ' + folder.string() + " --precomputed legacy" + options).code, 0);
        return text_of(folder / "state.json");
    };
    const std::string scaled = converted("model", " --units um");
    EXPECT_EQ(converted("model", ""), scaled);
    EXPECT_NE(converted("model", " --units nm"), scaled);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("m.vtp")).code, 0);
    EXPECT_EQ(converted("m.vtp", ""), scaled);
    EXPECT_EQ(run("convert " + out("model") + ' ' + out("m.pvtp")).code, 0);
    EXPECT_THAT(text_of(out("m-000000.vtp")), testing::HasSubstr("Name=\"MetresPerUnit\""));
    const Ran refused = run("convert " + out("model") + ' ' + out("m.pvtp") + " --units mm");
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.error, testing::HasSubstr("--units: is not for "));
    std::string manifest = text_of(fs::path(out("model")) / "manifest.json");
    manifest.replace(manifest.find("1e-06", manifest.find("\"metres")), 5, "-1.00");
    manifest.replace(manifest.find("\"checksum\""), 10, "\"unchecked\"");
    put_text(fs::path(out("model")) / "manifest.json", manifest);
    EXPECT_EQ(run("convert " + out("model") + ' ' + out("m.vtp")).code, 1);
}

TEST_F(BlockProgram, converts_a_folder_for_neuroglancer) {
    ASSERT_EQ(run(grains("model")).code, 0);
    const Ran ran = run("convert " + out("model") + ' ' + out("m.precomputed") + " --units um --precomputed legacy");
    ASSERT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, testing::HasSubstr("19 regions"));  // label 0 is background
    const fs::path folder = out("m.precomputed");
    EXPECT_THAT(text_of(folder / "info"), testing::HasSubstr("\"@type\": \"neuroglancer_legacy_mesh\""));
    EXPECT_THAT(text_of(folder / "names" / "info"), testing::HasSubstr("\"neuroglancer_segment_properties\""));
    const MeshFile whole = read_block_folder(out("model"));
    CheckOptions options;
    options.background = {0};
    for (const RegionReport& region : check(whole.mesh, options).regions) {
        const std::string label = whole.labels.text(whole.labels.input(region.label));
        const std::string list = text_of(folder / (label + ":0"));
        double volume = 0;
        for (std::size_t at = list.find(label + ":0:"); at != std::string::npos;
             at = list.find(label + ":0:", at + 1)) {
            const std::string name = list.substr(at, list.find('"', at) - at), bytes = text_of(folder / name);
            const std::size_t count = numbers_in<std::uint32_t>(bytes).at(0), corners = 4 + 12 * count;
            const auto p = numbers_in<float>(std::string_view(bytes).substr(4, 12 * count));
            const auto faces = numbers_in<std::uint32_t>(std::string_view(bytes).substr(corners));
            const auto at_corner = [&](std::uint32_t v) { return Vec3{p.at(3 * v), p.at(3 * v + 1), p.at(3 * v + 2)}; };
            for (std::size_t f = 0; f + 2 < faces.size(); f += 3)
                volume += dot(at_corner(faces[f]), cross(at_corner(faces[f + 1]), at_corner(faces[f + 2]))) / 6;
        }
        EXPECT_NEAR(volume / 1e9, region.volume, 1e-3 * region.volume) << label;  // micrometres to nanometres, cubed
    }
    const Ran other = run("convert " + out("m.precomputed") + ' ' + out("again.precomputed"));
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.error, testing::HasSubstr("m.precomputed: holds no surfaces"));
    EXPECT_FALSE(fs::exists(out("again.precomputed"))) << "a folder was left";
}

TEST_F(BlockProgram, takes_a_folder_that_a_run_was_killed_in_at_once) {
    fs::create_directory(out("model"));
    put_text(fs::path(out("model")) / ".manifest.json.part-1", "{");
    EXPECT_EQ(run(grains("model")).code, 0);
    fs::create_directory(out("other"));
    put_text(fs::path(out("other")) / "notes", "");
    EXPECT_THAT(run(grains("other")).error, testing::HasSubstr("holds other files"));
}

TEST_F(BlockProgram, one_run_works_in_a_folder) {
    ASSERT_EQ(run(grains("model")).code, 0);
    {
        const FolderLock lock(out("model"));
        const Ran refused = run(grains("model"));
        EXPECT_EQ(refused.code, 1);
        EXPECT_THAT(refused.error, testing::HasSubstr("another run works in it"));
        EXPECT_EQ(run("check " + out("model")).code, 0) << "reading it is no matter";
    }
    EXPECT_EQ(run(grains("model")).code, 0);
}

TEST_F(BlockProgram, damaged_labels_are_refused) {
    ASSERT_EQ(run(grains("model")).code, 0);
    const fs::path labels = fs::path(out("model")) / "labels.bin";
    std::string damaged = text_of(labels);
    damaged[11] ^= 1;
    put_text(labels, damaged);
    EXPECT_THAT(run("check " + out("model")).error, testing::HasSubstr("other labels than the manifest says"));
}

TEST_F(BlockProgram, warns_where_single_precision_is_too_coarse_for_neuroglancer) {
    grains("");  // writes grains.raw
    for (const auto& [origin, warns] : {std::pair("(0,0,0)", false), {"(1e5,2e5,3e5)", true}}) {
        put_text(path("g.nhdr"),
                 std::string("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 40 40 40\nspace dimension: 3\n"
                             "space directions: (0.01,0,0) (0,0.01,0) (0,0,0.01)\nspace origin: ") +
                     origin + "\nencoding: raw\ndata file: grains.raw\n");
        fs::remove_all(out("far"));
        ASSERT_EQ(run("reconstruct " + path("g.nhdr").string() + " --block-size 14 --quiet -o " + out("far")).code, 0);
        const std::string convert = "convert " + out("far") + ' ' + out("m.precomputed") + " --precomputed legacy";
        const Ran ran = run(convert);
        EXPECT_EQ(ran.code, 0);
        EXPECT_EQ(ran.error.find("single precision") != std::string::npos, warns) << origin;
    }
}

TEST_F(BlockProgram, goes_on_with_a_share_written_otherwise) {
    const std::string line = grains("model"), word = "--reduce 75%";
    ASSERT_NE(line.find(word), std::string::npos);
    ASSERT_EQ(run(line).code, 0);
    const auto with = [&](const std::string& share) {
        return run(std::string(line).replace(line.find(word), word.size(), "--reduce " + share));
    };
    EXPECT_EQ(with("0.75").code, 0);
    EXPECT_EQ(with("0.7").code, 1);
    EXPECT_EQ(with("7.5%").code, 1);
}

TEST_F(BlockProgram, refuses_a_changed_run_in_one_line) {
    ASSERT_EQ(run(grains("model")).code, 0);
    const Ran other = run(grains("model") + " --min-quality 0.05");
    EXPECT_EQ(other.code, 1);
    EXPECT_EQ(std::ranges::count(other.error, '\n'), 1) << other.error;
    EXPECT_THAT(other.error, testing::HasSubstr("was begun with --min-quality not given, and this run has 0.05"));
    put_text(path("grains.raw"), std::string(64000, 'x'));
    const Ran changed = run(grains("model"));
    EXPECT_EQ(changed.code, 1);
    EXPECT_THAT(changed.error, testing::HasSubstr("was begun with input 1 grains.raw, 64000 bytes, changed 2"));
    EXPECT_THAT(changed.error, testing::HasSubstr(", and this run has grains.raw, 64000 bytes, changed 2"));
}

TEST_F(BlockProgram, refuses_changed_files_that_the_input_or_an_option_names) {
    const auto refused = [&](const std::string& arguments, const std::string& said) {
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, 1) << arguments;
        EXPECT_THAT(ran.error, testing::HasSubstr(said));
    };
    grains("");  // writes grains.raw
    const std::string last = " --block-size 14 --quiet -o ";
    put_text(path("g.nhdr"),
             "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 40 40 40\nencoding: raw\ndata file: grains.raw\n");
    put_text(path("m.csv"), "1,2\n");
    const std::string header = "reconstruct " + path("g.nhdr").string(),
                      merged = header + " --merge " + path("m.csv").string();
    ASSERT_EQ(run(merged + last + out("merged")).code, 0);
    put_text(path("m.csv"), "1,3\n");
    refused(merged + last + out("merged"), "was begun with --merge m.csv, 4 bytes");
    ASSERT_EQ(run(header + last + out("header")).code, 0);
    put_text(path("grains.raw"), std::string(64000, 'x'));
    refused(header + last + out("header"), "was begun with samples 1 grains.raw, 64000 bytes");
    put_text(path("g.csv"), "label,name\n3,old\n");
    ASSERT_EQ(run(header + last + out("named")).code, 0);
    put_text(path("g.csv"), "label,name\n3,new\n");
    refused(header + last + out("named"), "was begun with names in or beside the input 1 name, 0 colours");

    const fs::path store = path("s.zarr");
    fs::copy(data("chunked/zarr2/type_uint8.zarr"), store, fs::copy_options::recursive);
    const std::string zarr = "reconstruct " + store.string();
    ASSERT_EQ(run(zarr + last + out("zarr")).code, 0);
    EXPECT_EQ(run(zarr + last + out("zarr")).code, 0);
    for (const auto& entry : fs::recursive_directory_iterator(store))
        if (entry.is_regular_file()) put_text(entry.path(), text_of(entry.path()));
    refused(zarr + last + out("zarr"), "was begun with input 1 s.zarr");

    const fs::path group = path("l.n5");
    fs::copy(data("chunked/n5/bad/levels.n5"), group, fs::copy_options::recursive);
    const std::string level = "reconstruct " + (group / "volume/s1").string();
    ASSERT_EQ(run(level + last + out("n5")).code, 0);
    const fs::path above = group / "volume/attributes.json";
    std::string attributes = text_of(above);
    const std::size_t place = attributes.find("0.5");
    ASSERT_NE(place, std::string::npos);
    put_text(above, attributes.replace(place, 3, "0.7"));
    refused(level + last + out("n5"), "samples, spacing 1 4 10, ");
}

TEST_F(BlockProgram, keeps_to_the_memory_or_says_that_it_cannot) {
    const std::string arguments = grains("model");
    const Ran refused = run(arguments + " --memory 10kB");
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.error, testing::HasSubstr("--memory 10 kB: "));
    EXPECT_THAT(refused.error, testing::HasSubstr("in blocks of 14 cells; raise --memory to that"));
    EXPECT_EQ(run(arguments + " --memory 200MB --memory-limit hard").code, 0);
}

TEST_F(BlockProgram, refuses_an_input_without_cells_or_regions_and_leaves_nothing) {
    put_text(path("one.raw"), std::string(400, '\3'));
    put_text(path("two.raw"), std::string(500, '\0') + std::string(500, '\1'));
    const std::string one = "reconstruct " + path("one.raw").string() + " --type uint8 --size ",
                      two = "reconstruct " + path("two.raw").string() + " --type uint8 --size 10,10,10 ";
    const auto expect_refused = [&](const std::string& arguments, const std::string& said) {
        const Ran ran = run(arguments + " -o " + out("m/"));
        EXPECT_EQ(ran.code, 1);
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
        EXPECT_THAT(ran.error, testing::HasSubstr(said));
    };
    for (const char* size : {"1,20,20", "20,1,20", "20,20,1"}) expect_refused(one + size, "1 sample along");
    expect_refused(two + "--roi :,:,4:5 --block-size 8", "1 sample along z");
    expect_refused(two + "--background 0,1", "all of it is background");
    expect_refused(one + "2,10,20 --boundary open", "one label only");
    expect_refused(two + "--memory 1MB", "needs at least");
    EXPECT_FALSE(fs::exists(out("m"))) << "an empty folder was left";
    EXPECT_EQ(run(two + "--quiet -o " + out("m/")).code, 0) << "the folder is as good as new";
}

TEST_F(BlockProgram, a_folder_with_the_name_of_a_model_is_refused) {
    put_text(path("two.raw"), std::string(500, '\0') + std::string(500, '\1'));
    const std::string command =
        "reconstruct " + path("two.raw").string() + " --type uint8 --size 10,10,10 --block-size 8 --quiet -o ";
    for (const char* name : {"m.vtp", "m.STL"}) {
        const Ran refused = run(command + out(name));
        EXPECT_EQ(refused.code, 2);
        EXPECT_THAT(refused.error, testing::HasSubstr(std::string(name) + ": blocks are written into a folder"));
        EXPECT_FALSE(fs::exists(out(name)));
    }
    EXPECT_EQ(run(command + out("m.vtp/")).code, 0) << "with a / it is meant";
    EXPECT_EQ(run(command + out("m.vtp")).code, 0) << "that folder is there";
    EXPECT_EQ(run(command + out("scan.1")).code, 0);
}

TEST_F(BlockProgram, an_input_that_cannot_be_read_to_its_end_leaves_nothing) {
    const std::string whole = text_of(data("nrrd/big_gzip_int16.nrrd"));
    const std::string command = "reconstruct " + path("t.nrrd").string() + " --block-size 4 -o " + out("model");
    put_text(path("t.nrrd"), whole.substr(0, whole.size() - 30));
    const Ran refused = run(command);
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.error, testing::HasSubstr("ends early"));
    EXPECT_FALSE(fs::exists(out("model"))) << "an empty folder was left";
    put_text(path("t.nrrd"), whole);
    EXPECT_EQ(run(command).code, 0) << "the input was mended";
}

TEST_F(BlockProgram, an_input_that_changes_while_it_is_read_is_refused) {
    grains("");  // writes grains.raw
    const auto open = [&] {
        ReadOptions options;
        options.raw_size = {40, 40, 40};
        options.raw_type = SampleType::kU8;
        return open_sections({path("grains.raw")}, options);
    };
    // It is looked at once the labels are counted, and once the blocks are made.
    for (const int change : {1, 2, 3}) {
        fs::remove_all(out("model"));
        int looked = 0;
        const BlockOptions blocks{
            .folder = out("model"), .block_cells = 14, .identity = {{"input", "old"}}, .find_identity = [&] {
                return RunIdentity{{"input", ++looked == change ? "new" : "old"}};
            }};
        BlockTasks alone;
        if (change == 3) {
            EXPECT_NO_THROW(reconstruct_blocks(open, {.reduce = 0.75}, blocks, alone));
            EXPECT_EQ(looked, 2);
            continue;
        }
        try {
            reconstruct_blocks(open, {.reduce = 0.75}, blocks, alone);
            ADD_FAILURE() << "the change was not noticed";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("input changed while it was read"));
        }
        const auto left = files_in("model");
        EXPECT_EQ(left.empty(), change == 1);
        for (const auto& [name, bytes] : left) EXPECT_FALSE(name.ends_with(".piece")) << name;
        EXPECT_THROW(read_block_folder(out("model")), Error);
    }
}

TEST_F(BlockProgram, the_folder_and_the_log_may_lie_in_the_folder_of_the_input) {
    const fs::path sections = path("sections");
    fs::create_directory(sections);
    for (const char* name : {"1.png", "2.png", "3.png"}) fs::copy_file(data("png/gray8/s1.png"), sections / name);
    const Ran ran = run("reconstruct " + sections.string() + " --block-size 4 --log " +
                        (sections / "run.log").string() + " -o " + (sections / "model").string() + "/");
    EXPECT_EQ(ran.code, 0) << ran.error;
}

TEST_F(BlockProgram, refuses_what_blocks_do_not_have) {
    for (const auto& [options, said] : {std::pair("--html page.html", "--html: is for a model in one file"),
                                        std::pair("--preserve-volume", "--preserve-volume: needs the whole surface"),
                                        std::pair("--smooth-lines", "--smooth-lines: needs the whole surface"),
                                        std::pair("--edge-length 2", "--edge-length: needs the whole surface"),
                                        std::pair("--smooth-filter taubin", "smoothed inside the lattice")}) {
        const Ran ran = run(grains("model") + ' ' + options);
        EXPECT_NE(ran.code, 0);
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
        EXPECT_THAT(ran.error, testing::HasSubstr(said));
        EXPECT_EQ(fs::exists(out("model")), ran.code != 2) << "a usage error leaves no folder";
        fs::remove_all(out("model"));
    }
}

TEST_F(BlockProgram, names_and_colours_of_regions_are_kept) {
    put_text(path("names.csv"), "label,name,color\n3,liver,#c00040\n5,spleen,#00ff80\n99,not there,#123456\n");
    ASSERT_EQ(run(grains("model") + " --names " + path("names.csv").string()).code, 0);
    const LabelNames names{{3, "liver"}, {5, "spleen"}, {99, "not there"}};
    const LabelColours colours{{3, 0xc00040}, {5, 0x00ff80}, {99, 0x123456}};
    const MeshFile folder = describe_block_folder(out("model"));
    EXPECT_EQ(folder.names, names);
    EXPECT_EQ(folder.colours, colours);
    for (const char* output : {"whole.vtp", "m.pvtp", "m.precomputed"})
        ASSERT_EQ(run("convert " + out("model") + ' ' + out(output)).code, 0) << output;
    const LabelNames there{{3, "liver"}, {5, "spleen"}};
    const LabelColours seen{{3, 0xc00040}, {5, 0x00ff80}};
    int files = 0;
    for (const auto& entry : fs::directory_iterator(path("out"))) {
        if (entry.path().extension() != ".vtp") continue;
        const MeshFile file = read_mesh(entry.path());
        EXPECT_EQ(file.names, there) << entry.path();
        EXPECT_EQ(file.colours, seen) << entry.path();
        ++files;
    }
    EXPECT_EQ(files, 65);
    const auto properties =
        nlohmann::json::parse(text_of(fs::path(out("m.precomputed")) / "names" / "info")).at("inline");
    const auto& ids = properties.at("ids");
    ASSERT_EQ(properties.at("properties").at(1).at("id"), "colour");
    const auto at = [&](int property, const char* label) {
        return properties.at("properties")
            .at(property)
            .at("values")
            .at(static_cast<std::size_t>(std::ranges::find(ids, label) - ids.begin()));
    };
    EXPECT_EQ(at(0, "3"), "liver");
    EXPECT_EQ(at(1, "3"), "#c00040");
    EXPECT_EQ(at(1, "5"), "#00ff80");
    EXPECT_EQ(at(1, "4"), "");
    const auto state = nlohmann::json::parse(text_of(fs::path(out("m.precomputed")) / "state.json"));
    EXPECT_EQ(state.at("layers").at(0).at("segmentColors").at("5"), "#00ff80");
    const fs::path manifest = fs::path(out("model")) / "manifest.json";
    auto json = nlohmann::json::parse(text_of(manifest));
    json["colours"][0][1] = "red";
    json.erase("checksum");
    put_text(manifest, json.dump());
    const Ran refused = run("check " + out("model"));
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.error, testing::HasSubstr("manifest.json: has the colour 'red'; write it as #ff8000"));
    json.erase("colours");  // as in folders that were made before
    put_text(manifest, json.dump());
    EXPECT_TRUE(describe_block_folder(out("model")).colours.empty());
}

TEST_F(BlockProgram, an_input_that_allows_it_is_read_in_place) {
    ASSERT_EQ(run(grains("model")).code, 0);
    EXPECT_EQ(nlohmann::json::parse(text_of(fs::path(out("model")) / "manifest.json")).at("in_place"), true);
}

class MpiProgram : public BlockProgram {
protected:
    void SetUp() override {
        BlockProgram::SetUp();
        if (test::mpi_program().empty()) GTEST_SKIP() << "regionmesh-mpi was not built";
    }

    Ran run_ranks(int ranks, const std::string& arguments, const std::string& before = "") const {
        const std::string command =
            before +
            " OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 300 mpirun --oversubscribe -n " +
            std::to_string(ranks) + " '" + test::mpi_program() + "' " + arguments + " >'" + path("stdout").string() +
            "' 2>'" + path("stderr").string() + "' </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(path("stdout")), text_of(path("stderr"))};
    }
};

TEST_F(MpiProgram, gives_the_same_bytes_for_1_2_and_4_ranks_as_without_mpi) {
    ASSERT_EQ(run(grains("alone")).code, 0);
    for (const int ranks : {1, 2, 4}) {
        const std::string folder = "ranks" + std::to_string(ranks);
        const Ran ran = run_ranks(ranks, grains(folder));
        ASSERT_EQ(ran.code, 0) << ran.error;
        EXPECT_THAT(ran.out, testing::HasSubstr("in 64 pieces of up to 14 cells"));
        EXPECT_EQ(files_in(folder), files_in("alone"));
    }
}

TEST_F(MpiProgram, one_rank_prints_and_writes_the_log) {
    const Ran ran = run_ranks(2, grains("ranks") + " --verbose --log " + out("log.txt"));
    ASSERT_EQ(ran.code, 0) << ran.error;
    const std::string log = text_of(out("log.txt")), first = "regionmesh reconstruct ";
    EXPECT_NE(log.find(first), std::string::npos) << log;
    EXPECT_EQ(log.find(first), log.rfind(first)) << log;
}

TEST_F(MpiProgram, a_run_goes_on_with_ranks_where_one_process_was_killed) {
    if (test::shim().empty()) GTEST_SKIP() << "sanitizers let nothing be put before their allocator";
    const std::uint64_t calls = calls_of(grains("alone"));
    ASSERT_TRUE(run_and_kill(grains("killed"), calls / 2));
    const Ran ran = run_ranks(2, grains("killed"));
    ASSERT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(files_in("killed"), files_in("alone"));
}

/// Kills rank 1 when the first pieces are there.
TEST_F(MpiProgram, a_rank_that_dies_ends_the_run_which_then_goes_on) {
    ASSERT_EQ(run(grains("alone")).code, 0);
    const std::string killer = "(for n in $(seq 600); do sleep 0.02; [ -e '" + out("killed/pass-0-000001.piece") +
                               "' ] || continue; for p in $(pgrep -f '" + out("killed") +
                               "'); do grep -qsz '^OMPI_COMM_WORLD_RANK=1$' /proc/$p/environ && grep -qs "
                               "regionmesh-mpi /proc/$p/comm && kill -9 $p && exit; done; done) &";
    const Ran ran = run_ranks(3, grains("killed"), killer);
    EXPECT_NE(ran.code, 0) << ran.out;
    EXPECT_NE(ran.code, 124) << "the other ranks waited for it";
    EXPECT_THAT(ran.error + ran.out, testing::HasSubstr("rank 1"));
    EXPECT_THAT(ran.error + ran.out, testing::HasSubstr("signal 9"));
    const Ran again = run_ranks(3, grains("killed"));
    ASSERT_EQ(again.code, 0) << again.error;
    EXPECT_EQ(files_in("killed"), files_in("alone"));
}

TEST_F(MpiProgram, refuses_in_one_line_of_its_own) {
    const Ran ran = run_ranks(2, "reconstruct " + path("grains.raw").string() + " -o " + out("model.vtp"));
    EXPECT_NE(ran.code, 0);
    EXPECT_THAT(ran.error, testing::HasSubstr("processes share the blocks of a folder"));
    const Ran other = run_ranks(2, "check model.vtp");
    EXPECT_NE(other.code, 0);
    EXPECT_THAT(other.error, testing::HasSubstr("regionmesh-mpi: reconstruct is the command that ranks share"));
}

}  // namespace
}  // namespace regionmesh
