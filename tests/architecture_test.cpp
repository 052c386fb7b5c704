// The arrows of DESIGN section 3: who may include whom.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kRoot = REGIONMESH_SOURCE_DIR;
const fs::path kLibrary = kRoot / "src/regionmesh";

/// Folder: what it may include beside itself; a name with a dot is a file. Folders that do not exist yet are listed, too.
const std::map<std::string, Names> kArrows{
    {"base", {}},
    {"volume", {"base"}},
    {"tets", {"base", "volume"}},
    {"model", {"base"}},
    {"decimate", {"base", "model"}},
    {"smooth", {"base", "model"}},
    {"check", {"base", "model"}},
    {"compare", {"base", "volume", "model", "check"}},
    {"stream", {"base", "volume", "tets", "model", "decimate", "smooth"}},
    {"tile", {"base", "volume", "tets", "model", "decimate", "smooth", "stream"}},
    {"source", {"base", "volume", "tets", "model", "check", "stream", "census.h", "memory_plan.h"}},
    {"io", {"base", "volume", "tets", "model", "check", "compare", "report.h"}},
};

/// What a file includes of ours: paths below regionmesh/.
std::vector<std::string> includes_of(const fs::path& file) {
    static const std::regex pattern(R"(^\s*#\s*include\s*[<"]regionmesh/([^">]+)[">])");
    std::vector<std::string> includes;
    std::ifstream stream(file);
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
        if (std::regex_search(line, match, pattern)) includes.push_back(match[1]);
    return includes;
}

/// "base" for base/vec3.h, "report.h" for report.h itself.
std::string first_part(const std::string& path) { return path.substr(0, path.find('/')); }

template <class Visit>
void for_sources(const fs::path& folder, Visit&& visit) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") visit(entry.path());
}

TEST(Architecture, every_folder_has_its_arrows) {
    for (const auto& entry : fs::directory_iterator(kLibrary)) {
        if (!entry.is_directory()) continue;
        EXPECT_TRUE(kArrows.contains(entry.path().filename().string())) << entry.path();
    }
}

TEST(Architecture, arrows_point_only_as_the_design_says) {
    int seen = 0;
    for (const auto& [folder, may] : kArrows) {
        if (!fs::exists(kLibrary / folder)) continue;
        for_sources(kLibrary / folder, [&](const fs::path& file) {
            for (const std::string& include : includes_of(file)) {
                ++seen;
                const std::string target = first_part(include);
                EXPECT_TRUE(target == folder || may.contains(target)) << file.string() << " includes " << include;
            }
        });
    }
    EXPECT_GT(seen, 50) << "this test looks in the wrong place";
}

TEST(Architecture, nothing_but_regionmesh_h_includes_io) {
    for_sources(kLibrary, [&](const fs::path& file) {
        if (file == kLibrary / "regionmesh.h" || first_part(fs::relative(file, kLibrary).string()) == "io") return;
        for (const std::string& include : includes_of(file)) EXPECT_NE(first_part(include), "io") << file.string() << " includes " << include;
    });
}

TEST(Architecture, formats_of_volumes_models_and_tetrahedra_do_not_see_one_another) {
    for (const std::string folder : {"io/volumes", "io/models", "io/tetrahedra"})
        for_sources(kLibrary / folder, [&](const fs::path& file) {
            for (const std::string& include : includes_of(file)) {
                const bool is_format = include.starts_with("io/") && include.find('/', 3) != std::string::npos;
                EXPECT_TRUE(!is_format || include.starts_with(folder + '/')) << file.string() << " includes " << include;
            }
        });
}

TEST(Architecture, nothing_includes_the_whole) {
    for_sources(kLibrary, [&](const fs::path& file) {
        for (const std::string& include : includes_of(file)) EXPECT_NE(include, "regionmesh.h") << file.string();
    });
}

TEST(Architecture, the_library_and_the_program_under_the_gpl_share_no_code) {
    for_sources(kRoot / "delaunay", [&](const fs::path& file) { EXPECT_TRUE(includes_of(file).empty()) << file.string(); });
    for_sources(kLibrary, [&](const fs::path& file) {
        std::ifstream stream(file);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const bool may = file == kLibrary / "base/exact_predicates.cpp";  // compiled so that the GPL part is an error
        EXPECT_TRUE(may || text.find("#include <CGAL") == std::string::npos) << file.string();
    });
}

TEST(Architecture, programs_include_public_headers_only) {
    for_sources(kRoot / "cli", [&](const fs::path& file) {
        for (const std::string& include : includes_of(file)) {
            const bool is_public = include == "regionmesh.h" || include == "pipeline.h" || first_part(include) == "base";
            EXPECT_TRUE(is_public) << file.string() << " includes " << include;
        }
    });
}

TEST(Architecture, a_source_includes_its_own_header_first) {
    for_sources(kLibrary, [&](const fs::path& file) {
        fs::path header = file;
        header.replace_extension(".h");
        if (file.extension() != ".cpp" || !fs::exists(header)) return;
        const auto includes = includes_of(file);
        ASSERT_FALSE(includes.empty()) << file.string();
        EXPECT_EQ(includes[0], fs::relative(header, kLibrary).generic_string());
    });
}

TEST(Architecture, files_stay_within_400_lines) {
    for_sources(kLibrary, [&](const fs::path& file) {
        std::ifstream stream(file);
        int lines = 0;
        for (std::string line; std::getline(stream, line);) ++lines;
        EXPECT_LE(lines, 400) << file.string();
    });
}

}  // namespace
}  // namespace regionmesh
