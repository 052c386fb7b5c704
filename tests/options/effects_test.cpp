// Every option has an effect: for each command that takes one there is an input on which it changes the result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cli/program.h"
#include "regionmesh/options.h"
#include "support/random.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kAll = ~0u, kLattices = kReconstruct | kCheck | kInfo | kVoxelise,
                        kTables = kReconstruct | kCheck | kInfo;

/// What the option must change.
enum class Part {
    kFiles,    // bytes of the files written; the run is good
    kNewFile,  // there is one more
    kText,     // what is printed
    kAny,      // any of these, or the exit code: a refusal, or another finding
};

/// How the command is run, with and without the option. Names in braces stand for files (Files).
struct Way {
    std::string source = "{grains}", model = "{model}";
    std::string output = {};  // of the command; empty: the usual one
    std::string more = {};
};

struct Effect {
    std::string option;
    std::string value;  // empty for flags
    Part part = Part::kAny;
    std::uint32_t commands = kAll;  // the first row of an option with the command counts
    Way way = {};
};

const Way kReduced{.more = "--reduce 60%"}, kTaubin{.more = "--smooth-filter taubin"},
    kOfPoints{.source = "{points}", .model = "{model_of_points}"}, kRaw{.source = "{raw}"};

/// A new option needs a row for each command that takes it, or a reason in kWithoutEffect.
const std::vector<Effect> kEffects{
    // Input
    {"sweep", "z", Part::kFiles, kReconstruct, kReduced},
    {"sweep", "z", Part::kText, kInfo},
    {"spacing", "1,2,3"},
    {"layer", "1", Part::kAny, kAll, {.source = "{layers}"}},
    {"threshold", "3"},
    {"argmax", "", Part::kAny, kAll, {.source = "{layers}"}},
    {"pitch", "1.5", Part::kAny, kAll, {.source = "{contours}"}},
    {"priority", "a", Part::kAny, kAll, {.source = "{contours}", .model = "{model_of_contours}"}},
    {"max-work", "5"},
    {"external-files", "", Part::kAny, kAll, {.source = "{header}"}},
    {"size", "12,13,14", Part::kAny, kAll, {.source = "{raw}", .more = "--type uint8"}},
    {"type", "int8", Part::kAny, kAll, {.source = "{raw}", .more = "--size 14,13,12"}},
    {"roi", "1:9,:,:"},
    {"box", "1:9,:,:"},
    {"merge", "{merge}"},
    {"labels", "1,2,3"},
    {"downsample", "2"},
    {"min-region", "20", Part::kAny, kCheck, {.more = "--denoise off"}},
    {"min-region", "20"},
    {"columns", "X=a,Y=b,Z=c,LABEL=label", Part::kAny, kAll, {.source = "{columns}"}},
    {"step", "0.7", Part::kAny, kAll, {.source = "{drill}", .model = "{model_of_drill}"}},
    {"layers", "auto", Part::kAny, kAll, {.source = "{drill}"}},
    {"collars", "{data}/layers/collars.collars", Part::kAny, kAll, {.source = "{data}/layers/intervals.csv"}},
    {"surveys",
     "{data}/layers/dips.surveys",
     Part::kAny,
     kAll,
     {.source = "{data}/layers/intervals.csv",
      .model = "{model_of_intervals}",
      .more = "--collars {data}/layers/collars.collars"}},
    {"terrain",
     "{data}/layers/corner.asc",
     Part::kAny,
     kAll,
     {.source = "{data}/layers/holes.csv", .more = "--layers auto --spacing 50,50,5"}},
    {"scale-z", "4", Part::kFiles, kReconstruct, kReduced},
    {"scale-z", "4", Part::kAny, kAll, kOfPoints},
    {"array", "none", Part::kAny, kAll, {.source = "{data}/meshes/vtk_ascii.vtu"}},
    {"hull", "", Part::kAny, kAll, {.source = "{points}", .more = "--boundary open"}},
    {"sections", "{grains}", Part::kAny, kAll, {.source = ""}},
    {"weld", "0.01", Part::kAny, kVoxelise, {.model = "{apart_and_turned}", .more = "--orient"}},
    {"weld", "0.01", Part::kAny, kAll, {.model = "{apart}"}},
    {"orient", "", Part::kAny, kAll, {.model = "{turned}"}},

    // Labels
    {"background", "1"},
    {"no-background", ""},
    {"boundary", "open", Part::kAny, kDecimate | kRemesh, {.model = "{open}"}},
    {"boundary", "open"},
    {"cells", "tetrahedra", Part::kFiles, kReconstruct},
    {"cells", "tetrahedra"},
    {"outside",
     "7",
     Part::kFiles,
     kAll,
     {.source = "{wide}", .model = "{without_background}", .more = "--no-background"}},

    // Decimation
    {"for", "fe", Part::kFiles, kReconstruct},
    {"target-faces", "300", Part::kFiles, kReconstruct},
    {"target-faces", "300", Part::kFiles, kDecimate, {.more = "--improve"}},
    {"reduce", "70%", Part::kFiles, kReconstruct},
    {"reduce", "70%", Part::kFiles, kDecimate, {.more = "--improve"}},
    {"max-error", "0.02", Part::kFiles, kRemesh},
    {"max-error", "0.1", Part::kFiles, kAll, {.more = "--reduce 90%"}},
    {"perturbation", "0.5", Part::kFiles, kAll, kReduced},
    {"placement", "lindstrom-turk", Part::kFiles, kAll, kReduced},
    {"no-decimate", "", Part::kAny, kAll, kReduced},

    // Smoothing
    {"smooth", "strong", Part::kFiles, kAll, kTaubin},
    {"smooth-filter", "laplacian", Part::kFiles},
    {"smooth-lambda", "0.2", Part::kFiles, kAll, kTaubin},
    {"between", "1"},
    {"align", "translate", Part::kAny, kAll, {.source = "{jittered}", .model = "{model_of_jittered}"}},
    {"room", "1"},
    {"denoise", "off"},
    {"specks", "off"},
    {"smooth-points", "", Part::kFiles, kAll, kTaubin},
    {"preserve-volume", "", Part::kFiles, kAll, kTaubin},
    {"scale", "5", Part::kFiles, kAll, {.more = "--smooth-filter nifpms"}},

    // Promises
    {"min-quality", "0.2", Part::kFiles, kSmooth, {.more = "--smooth-filter laplacian --smooth 60"}},
    {"min-quality", "0.2", Part::kFiles, kRemesh},
    {"min-quality", "0.2", Part::kFiles, kAll, {.more = "--reduce 90%"}},
    {"edge-length", "3", Part::kFiles, kAll, kReduced},
    {"smooth-lines", "", Part::kFiles, kRemesh},
    {"smooth-lines", "", Part::kFiles, kAll, kReduced},
    {"improve", "", Part::kFiles, kRemesh},
    {"improve", "", Part::kFiles, kAll, kReduced},
    {"no-keep-samples", "", Part::kFiles, kAll, {.more = "--reduce 90%"}},
    {"no-intersect-check",
     "",
     Part::kFiles,
     kSmooth,
     {.more = "--smooth-filter laplacian --smooth 100 --min-quality 0"}},
    {"no-intersect-check", "", Part::kFiles, kDecimate, {.more = "--reduce 99% --min-quality 0"}},
    {"no-intersect-check", "", Part::kFiles, kAll, {.more = "--reduce 95% --min-quality 0 --no-keep-samples"}},

    // Output
    {"block-size", "6", Part::kAny, kAll, {.output = "folder/"}},
    {"names", "{names}"},
    {"per-region", "", Part::kFiles, kAll, {.output = "m.stl"}},
    {"ascii", "", Part::kFiles, kAll, {.output = "m.stl"}},
    {"space", "lps", Part::kFiles, kAll, {.source = "{ras}", .model = "{model_in_ras}"}},
    {"units", "mm", Part::kFiles},
    {"regions", "{out}/t.csv", Part::kNewFile},
    {"interfaces", "{out}/t.csv", Part::kNewFile},
    {"lines", "{out}/t.csv", Part::kNewFile},
    {"report", "{out}/r.json", Part::kNewFile},
    {"write-labels", "{out}/w.npy", Part::kNewFile},
    {"json", "{out}/j.json", Part::kNewFile},
    {"html", "{out}/p.html", Part::kNewFile},
    {"distance", "{out}/d.vtp", Part::kNewFile},
    {"log", "{out}/log.txt", Part::kNewFile},
    {"force", "", Part::kAny, kCheck | kCompare | kInfo, {.more = "--json {locked}"}},
    {"force", "", Part::kAny, kAll, {.output = "locked/"}},
    {"preview-faces", "100", Part::kFiles, kView},
    {"preview-faces", "100", Part::kFiles, kAll, {.more = "--html {out}/p.html"}},
    {"precomputed", "legacy", Part::kFiles, kAll, {.output = "m.precomputed", .more = "--units nm"}},
    {"levels", "2", Part::kFiles, kAll, {.output = "m.precomputed", .more = "--units nm"}},
    {"sharded", "", Part::kFiles, kAll, {.output = "m.precomputed", .more = "--units nm"}},
    {"samples", "100", Part::kText},
    {"all", "", Part::kText, kAll, {.source = "{many}"}},

    // Run
    {"config", "{config}"},
    {"memory", "1MB"},
    {"quiet", "", Part::kText},
    {"verbose", "", Part::kText},
};

struct WithoutEffect {
    std::string option;
    std::uint32_t commands;
    const char* reason;
};
const std::vector<WithoutEffect> kWithoutEffect{
    {"sweep", kCheck, "findings do not depend on the order in which sections are read"},
    {"step", kCheck, "topology, which a check compares, is the same for any distance of points but the largest"},
    {"edge-length", kRemesh, "the command is refused without it"},
    {"surveys", kCheck, "topology is the same, unless holes meet"},
    {"threads", kAll, "the result is the same for any number"},
    {"no-sync", kAll, "shows after a loss of power only"},
    {"no-sandbox", kAll, "shows where the program does what the sandbox forbids: sandbox_test.cpp"},
    {"require-sandbox", kAll, "shows where the kernel has no sandbox: sandbox_test.cpp"},
    {"face-budget", kAll, "shows in models far larger than this one: stream/budget_test.cpp"},
    {"memory-limit", kAll, "shows where a run exceeds --memory: usage_test.cpp"},
};

/// NumPy's format, version 1; `type` as it names them.
std::string npy(const std::string& shape, const std::string& type, const std::string& data) {
    std::string head = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
    head.resize((head.size() + 11 + 63) / 64 * 64 - 11, ' ');
    head += '\n';
    const auto size = static_cast<char>(head.size());
    return "\x93NUMPY\x01" + std::string(1, '\0') + size + std::string(1, '\0') + head + data;
}

/// A tetrahedron, no corner of which is a sample; its faces have corners of their own, `gap` apart, or the second face
/// is turned over.
std::string tetrahedron(double gap, bool is_turned) {
    constexpr double kCorners[4][3] = {{0.3, 0.3, 0.3}, {3.4, 0.3, 0.3}, {0.3, 3.4, 0.3}, {0.3, 0.3, 3.4}};
    constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    std::string points, faces;
    const auto add_point = [&](int corner, double shift) {
        for (const double x : kCorners[corner]) points += std::to_string(x + shift) + ' ';
    };
    for (int corner = 0; gap == 0 && corner < 4; ++corner) add_point(corner, 0);
    for (int f = 0; f < 4; ++f)
        for (int n = 0; n < 3; ++n) {
            const int corner = kFaces[f][is_turned && f == 1 ? 2 - n : n];
            if (gap > 0) add_point(corner, gap * f);
            faces += std::to_string(gap > 0 ? 3 * f + n : corner) + ' ';
        }
    const std::string array = "</DataArray>";
    return "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\"><PolyData>"
           "<Piece NumberOfPoints=\"" +
           std::string(gap > 0 ? "12" : "4") +
           "\" NumberOfPolys=\"4\">"
           "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
           points + array +
           "</Points><CellData><DataArray type=\"Int64\" Name=\"BoundaryLabels\" NumberOfComponents=\"2\" "
           "format=\"ascii\">0 1 0 1 0 1 0 1" +
           array + "</CellData><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" + faces +
           array + "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6 9 12" + array +
           "</Polys></Piece></PolyData></VTKFile>\n";
}

/// A tube through twelve sections of 30 x 30 samples, every second one moved by three samples.
std::string jittered_tube() {
    std::string labels;
    for (int k = 0; k < 12; ++k)
        for (int j = 0; j < 30; ++j)
            for (int i = 0; i < 30; ++i) {
                const int x = i - (k % 2 == 0 ? 13 : 16), y = j - 15;
                labels += static_cast<char>(x * x + y * y < 60);
            }
    return labels;
}

class Effects : public Program {
protected:
    struct Result {
        int code = 0;
        std::string text;
        std::map<std::string, std::string> files;
        bool is_good() const { return code == 0 || code == 3; }
        bool operator==(const Result&) const = default;
    };

    void SetUp() override {
        if (test::delaunay_program().empty()) GTEST_SKIP() << "built without regionmesh-delaunay";
        Program::SetUp();
        put_inputs();
        put_models();
    }

    std::string put(const std::string& key, const std::string& name, const std::string& text) {
        put_text(path(name), text);
        return files_[key] = path(name).string();
    }

    void put_inputs() {
        files_["out"] = path("out").string();
        files_["locked"] = path("out/locked.json").string();
        files_["data"] = test::data_folder();
        // Grains with stray samples.
        const test::ArrayVolume volume = test::grain_volume({14, 13, 12}, 9, 5);
        std::string grains(volume.labels().begin(), volume.labels().end());
        test::Random random(7);
        for (int n = 0; n < 40; ++n) grains[random.below(grains.size())] = static_cast<char>(random.below(9));
        std::string others = grains, many, wide(20 * 20 * 20, '\0');
        for (char& label : others) label = static_cast<char>((label + 1) % 9);
        for (int n = 0; n < 4096; ++n) many += {static_cast<char>(n % 256), static_cast<char>(n / 256)};
        put("grains", "grains.npy", npy("12, 13, 14", "|u1", grains));
        put("many", "many.npy", npy("16, 16, 16", "<u2", many));
        put("wide", "wide.npy", npy("20, 20, 20", "|u1", wide));
        put("raw", "grains.raw", grains);
        put("jittered", "jittered.npy", npy("12, 30, 30", "|u1", jittered_tube()));
        const std::string head = "NRRD0004\ntype: uint8\nencoding: raw\n", size = "dimension: 3\nsizes: 14 13 12\n";
        fs::create_directory(path("far"));
        put_text(path("far/grains.raw"), grains);
        fs::create_directory(path("near"));
        put("header", "near/grains.nhdr", head + size + "data file: " + path("far/grains.raw").string() + "\n");
        put("layers", "layers.nrrd",
            head + "dimension: 4\nsizes: 14 13 12 2\nkinds: domain domain domain list\n\n" + grains + others);
        put("ras", "ras.nrrd",
            head + size +
                "space: right-anterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                "space origin: (0,0,0)\n\n" +
                grains);
        put("merge", "merge.csv", "old,new\n1,2\n");
        put("names", "names.csv", "label,name\n1,one\n2,two\n");
        put("config", "config.toml", "no-such-option = 1\n");
        std::string points;
        for (int x = 0; x < 5; ++x)
            for (int y = 0; y < 5; ++y)
                for (int z = 0; z < 4; ++z) {
                    for (const int at : {x, 2 * y, z}) points += std::to_string(at + 0.3 * random.unit()) + ',';
                    points += std::to_string(1 + (x + y > 3) + (z > 1)) + '\n';
                }
        put("points", "points.csv", "x,y,z,label\n" + points);
        put("contours", "contours.csv",
            "label,contour,z,x,y\na,1,0,0,0\na,1,0,9,0\na,1,0,9,9\na,1,0,0,9\na,1,2,0,0\na,1,2,9,0\na,1,2,9,9\n"
            "b,1,0,4,0\nb,1,0,12,0\nb,1,0,12,9\nb,1,2,4,0\nb,1,2,12,0\nb,1,2,12,9\n");
        put("columns", "columns.csv", "a,b,c,label\n" + points);
        std::string holes = "hole,x,y,surface,from,to,label\n";
        const int places[5][3] = {{0, 0, 3}, {6, 1, 4}, {1, 7, 5}, {6, 6, 6}, {3, 3, 5}};
        for (int n = 0; n < 5; ++n)
            for (const bool is_low : {false, true}) {
                const auto& [x, y, depth] = places[n];
                holes += std::string(1, static_cast<char>('A' + n)) + ',' + std::to_string(x) + ',' +
                         std::to_string(y) + ",10," + std::to_string(is_low ? depth : 0) + ',' +
                         std::to_string(is_low ? 9 : depth) + ',' + (is_low ? "2\n" : "1\n");
            }
        put("drill", "drill.csv", holes);
        put("apart", "apart.vtp", tetrahedron(0.001, false));
        put("turned", "turned.vtp", tetrahedron(0, true));
        put("apart_and_turned", "apart_and_turned.vtp", tetrahedron(0.001, true));
    }

    void put_models() {
        const std::pair<std::string, std::string> models[] = {
            {"model", "{grains} --smooth off --denoise off --no-decimate"},
            {"other", "{grains} --reduce 50%"},
            {"open", "{grains} --smooth off --boundary open"},
            {"without_background", "{grains} --smooth off --no-background"},
            {"model_in_ras", "{ras} --smooth off"},
            {"model_of_contours", "{contours} --smooth off --denoise off --no-decimate"},
            {"model_of_jittered", "{jittered} --reduce 60%"},
            {"model_of_points", "{points}"},
            {"model_of_drill", "{drill}"},
            {"model_of_intervals", "{data}/layers/intervals.csv --collars {data}/layers/collars.collars"}};
        for (const auto& [name, arguments] : models) {
            files_[name] = path(name + ".vtp").string();
            const Ran ran = run(with_files("reconstruct " + arguments + " -o {" + name + "}"));
            ASSERT_TRUE(ran.code == 0 || ran.code == 3) << name << ran.error;
        }
    }

    std::string with_files(std::string text) const {
        for (const auto& [name, file] : files_)
            for (std::size_t at; (at = text.find('{' + name + '}')) != std::string::npos;)
                text.replace(at, name.size() + 2, file);
        EXPECT_EQ(text.find('{'), std::string::npos) << text;
        return text;
    }

    static std::string line_of(const CommandSpec& command, const Way& way, bool is_of_samples) {
        const std::string name(command.name);
        const auto to = [&](const std::string& file) {
            if (way.output == "locked/") return "{out}/locked/" + file;
            return "{out}/" + (way.output.empty() ? file : way.output);
        };
        std::string line = name + ' ';
        switch (command.command) {
            case kReconstruct:
                line += way.source + " -o " + to("m.vtp");
                break;
            case kDecimate: {
                const bool has_target =
                    way.more.find("--reduce") != std::string::npos || way.more.find("--improve") != std::string::npos;
                line += way.model + " -o " + to("m.vtp") + (has_target ? "" : " --reduce 60%");
                break;
            }
            case kRemesh:
                line += way.model + " -o " + to("m.vtp");
                if (way.more.find("--edge-length") == std::string::npos) line += " --edge-length 2";
                break;
            case kSmooth:
                line += way.model + " -o " + to("m.vtp");
                break;
            case kCheck:
                line += way.model + (way.source.empty() ? "" : " --sections " + way.source);
                break;
            case kConvert:
                line += way.model + ' ' + to("m.vtp");
                break;
            case kCompare:
                line += way.model + " {other}" + (is_of_samples ? "" : " --samples 2000");
                break;
            case kInfo:
                line += way.source;
                break;
            case kVoxelise:
                line += way.model + " --like " + way.source + " -o " + to("l.npy");
                break;
            case kView:
                line += way.model + " -o " + to("m.html");
                break;
        }
        return line + ' ' + way.more;
    }

    Result result_of(const std::string& line) {
        const fs::path folder = path("out");
        fs::remove_all(folder);
        fs::create_directory(folder);
        if (line.find("{out}/locked/") != std::string::npos) fs::create_directory(folder / "locked");
        const std::string arguments = with_files(line);
        for (const char* name : {"locked/m.vtp", "locked/l.npy", "locked/m.html", "locked.json"})
            if (arguments.find((folder / name).string()) != std::string::npos) {
                put_text(folder / name, "read-only");
                fs::permissions(folder / name, fs::perms::owner_read);
            }
        const Ran ran = run(arguments);
        // Times and sizes of memory vary.
        static const std::regex varying(R"([0-9.,]+ (s|ms|MB|GB|kB)\b)");
        Result result{.code = ran.code, .text = std::regex_replace(ran.out + ran.error, varying, "#"), .files = {}};
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                result.files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
        return result;
    }

    const Result& cached(const std::string& line) {
        const auto known = results_.find(line);
        return known != results_.end() ? known->second : results_.emplace(line, result_of(line)).first->second;
    }

    void expect_effect(const CommandSpec& command, const Effect& effect) {
        const std::string line = line_of(command, effect.way, effect.option == "samples");
        const std::string with = line + " --" + effect.option + (effect.value.empty() ? "" : " " + effect.value);
        SCOPED_TRACE(with);
        const Result before = cached(line), after = result_of(with);
        EXPECT_TRUE(before.is_good() || after.is_good()) << before.text << after.text;
        switch (effect.part) {
            case Part::kFiles:
                EXPECT_TRUE(after.is_good()) << after.text;
                EXPECT_NE(before.files, after.files) << "no effect";
                break;
            case Part::kNewFile:
                EXPECT_TRUE(after.is_good()) << after.text;
                EXPECT_EQ(after.files.size(), before.files.size() + 1) << "no effect";
                break;
            case Part::kText:
                EXPECT_NE(before.text, after.text) << "no effect";
                break;
            case Part::kAny:
                EXPECT_FALSE(before == after) << "no effect";
                break;
        }
    }

    std::map<std::string, std::string> files_;
    std::map<std::string, Result> results_;  // by line
};

TEST_F(Effects, every_option_has_one_in_every_command_that_takes_it) {
    for (const OptionSpec& option : option_table()) {
        if (option.is_argument || option.is_required) continue;  // a command without it is refused
        for (const CommandSpec& command : command_table()) {
            if ((option.commands & command.command) == 0) continue;
            SCOPED_TRACE(std::string(command.name) + ' ' + option.flag());
            const bool is_excused = std::ranges::any_of(kWithoutEffect, [&](const WithoutEffect& row) {
                return row.option == option.name && (row.commands & command.command) != 0;
            });
            if (is_excused) continue;
            const auto row = std::ranges::find_if(kEffects, [&](const Effect& effect) {
                return effect.option == option.name && (effect.commands & command.command) != 0;
            });
            ASSERT_NE(row, kEffects.end()) << "add a row to kEffects: an input on which the option changes the result";
            expect_effect(command, *row);
        }
    }
}

TEST(EffectRows, are_of_options_that_exist) {
    for (const Effect& effect : kEffects) EXPECT_NE(find_option(effect.option), nullptr) << effect.option;
    for (const WithoutEffect& row : kWithoutEffect) EXPECT_NE(find_option(row.option), nullptr) << row.option;
}

}  // namespace
}  // namespace regionmesh
