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

#include "support/paths.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kRoot = test::source_folder();
const fs::path kLibrary = kRoot / "src", kPublic = kRoot / "include/regionmesh";

/// Room: the rooms that it may include besides itself.
const std::map<std::string, Names> kArrows{
    {"base", {}},
    {"volume", {"base"}},
    {"mesh", {"base"}},
    {"cells", {"base", "mesh", "volume"}},
    {"simplify", {"base", "mesh", "volume"}},
    {"smooth", {"base", "mesh", "cells"}},
    {"check", {"base", "mesh"}},
    {"compare", {"base", "mesh", "volume", "check"}},
    {"stream", {"base", "mesh", "volume", "cells", "simplify", "smooth", "check"}},
    {"formats", {"base", "mesh", "volume", "check", "compare", "stream"}},
    {"boreholes", {"base", "volume", "formats"}},
    {"options", {"base", "mesh", "volume", "compare", "stream", "formats"}},
};

/// The room that a public header belongs to: the one that keeps its promise.
const std::map<std::string, std::string> kRoomOfHeader{
    {"error.h", "base"},
    {"flat_array.h", "base"},
    {"ids.h", "base"},
    {"label.h", "base"},
    {"label_oracle.h", "base"},
    {"process.h", "base"},
    {"vec3.h", "base"},
    {"label_names.h", "volume"},
    {"label_table.h", "volume"},
    {"lattice.h", "volume"},
    {"section_reader.h", "volume"},
    {"tetrahedron_reader.h", "volume"},
    {"mesh.h", "mesh"},
    {"typical_edge.h", "mesh"},
    {"census.h", "cells"},
    {"simplify.h", "simplify"},
    {"verdict.h", "simplify"},
    {"preserve_volume.h", "smooth"},
    {"smooth.h", "smooth"},
    {"smooth_options.h", "smooth"},
    {"smooth_report.h", "smooth"},
    {"check.h", "check"},
    {"fix_unsound.h", "check"},
    {"lines.h", "check"},
    {"compare.h", "compare"},
    {"statistics.h", "compare"},
    {"voxelise.h", "compare"},
    {"memory.h", "stream"},
    {"reconstruct.h", "stream"},
    {"report.h", "stream"},
    {"tetrahedron_census.h", "stream"},
    {"regionmesh.h", "the whole"},
    {"formats.h", "the whole"},
    {"label_names_file.h", "formats"},
    {"mesh_file.h", "formats"},
    {"output_file.h", "formats"},
    {"read_sections.h", "formats"},
    {"read_tetrahedra.h", "formats"},
    {"write_report.h", "formats"},
    {"options.h", "options"},
    {"write_volume.h", "formats"},
};

/// What a file includes of ours: "regionmesh/mesh.h", "base/hash.h".
std::vector<std::string> includes_of(const fs::path& file) {
    static const std::regex pattern(R"re(^\s*#\s*include\s*"([^"]+)")re");
    std::vector<std::string> includes;
    std::ifstream stream(file);
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
        if (std::regex_search(line, match, pattern)) includes.push_back(match[1]);
    return includes;
}

/// "base" for base/hash.h and for regionmesh/vec3.h.
std::string room_of(const std::string& include) {
    const std::string first = include.substr(0, include.find('/'));
    if (first != "regionmesh") return first;
    const auto place = kRoomOfHeader.find(include.substr(first.size() + 1));
    return place == kRoomOfHeader.end() ? "a public header without a room" : place->second;
}

template <class Visit>
void for_sources(const fs::path& folder, Visit&& visit) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") visit(entry.path());
}

TEST(Architecture, every_folder_has_its_arrows) {
    for (const auto& entry : fs::directory_iterator(kLibrary))
        EXPECT_TRUE(entry.is_directory() && kArrows.contains(entry.path().filename().string())) << entry.path();
}

TEST(Architecture, every_public_header_has_a_room) {
    for_sources(kPublic, [&](const fs::path& file) {
        EXPECT_TRUE(kRoomOfHeader.contains(file.filename().string())) << file.string();
    });
}

void expect_arrows(const fs::path& file, const std::string& room, const Names& may, int& seen) {
    for (const std::string& include : includes_of(file)) {
        ++seen;
        EXPECT_TRUE(room_of(include) == room || may.contains(room_of(include)))
            << file.string() << " includes " << include;
    }
}

TEST(Architecture, arrows_point_down_only) {
    int seen = 0;
    for (const auto& [room, may] : kArrows)
        for_sources(kLibrary / room, [&](const fs::path& file) { expect_arrows(file, room, may, seen); });
    for (const auto& [header, room] : kRoomOfHeader)
        if (room != "the whole") expect_arrows(kPublic / header, room, kArrows.at(room), seen);
    EXPECT_GT(seen, 500) << "this test looks in the wrong place";
}

TEST(Architecture, public_headers_include_public_headers_only) {
    for_sources(kPublic, [&](const fs::path& file) {
        for (const std::string& include : includes_of(file))
            EXPECT_TRUE(include.starts_with("regionmesh/")) << file.string() << " includes " << include;
    });
}

TEST(Architecture, nothing_includes_the_whole) {
    for_sources(kLibrary, [&](const fs::path& file) {
        for (const std::string& include : includes_of(file))
            EXPECT_TRUE(include != "regionmesh/regionmesh.h" && include != "regionmesh/formats.h") << file.string();
    });
}

TEST(Architecture, the_library_and_the_program_under_the_gpl_share_no_code) {
    for_sources(kRoot / "apps/delaunay",
                [&](const fs::path& file) { EXPECT_TRUE(includes_of(file).empty()) << file.string(); });
    for_sources(kLibrary, [&](const fs::path& file) {
        std::ifstream stream(file);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const bool may = file == kLibrary / "base/exact_predicates.cpp";  // compiled so that the GPL part is an error
        EXPECT_TRUE(may || text.find("#include <CGAL") == std::string::npos) << file.string();
    });
}

TEST(Architecture, programs_include_public_headers_and_their_own) {
    for_sources(kRoot / "apps/cli", [&](const fs::path& file) {
        for (const std::string& include : includes_of(file))
            EXPECT_TRUE(include.starts_with("regionmesh/") || include.find('/') == std::string::npos)
                << file.string() << " includes " << include;
    });
}

TEST(Architecture, a_source_includes_its_own_header_first) {
    for_sources(kLibrary, [&](const fs::path& file) {
        fs::path own = file;
        own.replace_extension(".h");
        if (file.extension() != ".cpp") return;
        const bool is_private = fs::exists(own), is_public = fs::exists(kPublic / own.filename());
        if (!is_private && !is_public) return;
        const auto includes = includes_of(file);
        ASSERT_FALSE(includes.empty()) << file.string();
        const std::string path =
            is_private ? fs::relative(own, kLibrary).generic_string() : "regionmesh/" + own.filename().string();
        EXPECT_EQ(includes[0], path) << file.string();
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
