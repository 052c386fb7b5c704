// Who may include whom: the table in CONTRIBUTING.md, enforced.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/paths.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kRoot = test::source_folder();
const fs::path kLibrary = kRoot / "src", kPublic = kRoot / "include/regionmesh";

/// The table of rooms in CONTRIBUTING.md: the rooms that a room may include, and the room that keeps the promise of a
/// public header.
struct Rooms {
    std::map<std::string, Names> may_include;
    std::map<std::string, std::string> of_header;
};

/// Room of the headers that include all others.
const std::string kAll = "all";

Names words_of(const std::string& cell) {
    std::istringstream stream(cell);
    return {std::istream_iterator<std::string>(stream), {}};
}

Rooms read_rooms() {
    static const std::regex row(R"re(\|([^|]*)\|([^|]*)\|([^|]*)\|)re");
    Rooms rooms;
    std::ifstream stream(kRoot / "CONTRIBUTING.md");
    bool is_table = false;
    std::smatch match;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("| room of `src` |")) {
            is_table = true;
            continue;
        }
        if (!is_table || !std::regex_match(line, match, row)) {
            if (is_table) break;
            continue;
        }
        std::string room = *words_of(match[1]).begin();
        std::erase(room, '`');
        if (room.starts_with("---")) continue;
        if (room != kAll) rooms.may_include[room] = words_of(match[2]);
        for (const std::string& header : words_of(match[3])) rooms.of_header[header + ".h"] = room;
    }
    return rooms;
}

const Rooms kRooms = read_rooms();

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
    const auto place = kRooms.of_header.find(include.substr(first.size() + 1));
    return place == kRooms.of_header.end() ? "a public header without a room" : place->second;
}

template <class Visit>
void for_sources(const fs::path& folder, Visit&& visit) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") visit(entry.path());
}

TEST(Architecture, every_folder_has_its_arrows) {
    Names folders, rooms;
    for (const auto& entry : fs::directory_iterator(kLibrary)) folders.insert(entry.path().filename().string());
    for (const auto& [room, may] : kRooms.may_include) rooms.insert(room);
    EXPECT_EQ(folders, rooms) << "folders of src, and rows of the table in CONTRIBUTING.md";
}

TEST(Architecture, every_public_header_has_a_room) {
    Names files, headers;
    for (const auto& entry : fs::directory_iterator(kPublic)) files.insert(entry.path().filename().string());
    for (const auto& [header, room] : kRooms.of_header) headers.insert(header);
    EXPECT_EQ(files, headers) << "files of include/regionmesh, and headers of the table in CONTRIBUTING.md";
}

void expect_arrows(const fs::path& file, const std::string& room, const Names& may, int& seen) {
    for (const std::string& include : includes_of(file)) {
        ++seen;
        EXPECT_TRUE(room_of(include) == room || may.contains(room_of(include)))
            << file.string() << " includes " << include;
    }
}

TEST(Architecture, includes_follow_the_table) {
    int seen = 0;
    for (const auto& [room, may] : kRooms.may_include)
        for_sources(kLibrary / room, [&](const fs::path& file) { expect_arrows(file, room, may, seen); });
    for (const auto& [header, room] : kRooms.of_header)
        if (room != kAll) expect_arrows(kPublic / header, room, kRooms.may_include.at(room), seen);
    EXPECT_GT(seen, 500) << "this test looks in the wrong place";
}

/// The rooms that the build makes regionmesh::core of.
Names rooms_of_core() {
    static const std::regex list(R"re(\nadd_room_library\(core ([^)]*)\))re");
    std::ifstream stream(kRoot / "CMakeLists.txt");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    std::smatch match;
    return std::regex_search(text, match, list) ? words_of(match[1]) : Names{};
}

TEST(Architecture, the_core_includes_no_library_of_files) {
    static const std::regex library(
        R"re(^\s*#\s*include\s*<((?!oneapi/|CGAL/|sys/|linux/|sanitizer/)[^>]*[/.][^>]*)>)re");
    const Names of_the_system{"emmintrin.h", "fcntl.h", "link.h", "malloc.h", "unistd.h"};
    const Names core = rooms_of_core();
    EXPECT_GT(core.size(), 10u) << "this test looks in the wrong place";
    for (const std::string& room : core)
        for_sources(kLibrary / room, [&](const fs::path& file) {
            std::ifstream stream(file);
            std::smatch match;
            for (std::string line; std::getline(stream, line);)
                EXPECT_TRUE(!std::regex_search(line, match, library) || of_the_system.contains(match[1]))
                    << file.string() << ": " << line;
        });
}

/// Depth first, down the arrows.
bool leads_to(const std::string& from, const std::string& to, Names& seen) {
    for (const std::string& next : kRooms.may_include.at(from))
        if (next == to || (seen.insert(next).second && leads_to(next, to, seen))) return true;
    return false;
}

TEST(Architecture, no_room_includes_itself_through_others) {
    for (const auto& [room, may] : kRooms.may_include) {
        for (const std::string& other : may) ASSERT_TRUE(kRooms.may_include.contains(other)) << room << ": " << other;
        Names seen;
        EXPECT_FALSE(leads_to(room, room, seen)) << room;
    }
}

TEST(Architecture, simplify_smooth_and_check_do_not_see_one_another) {
    const Names apart{"simplify", "smooth", "check"};
    for (const std::string& room : apart)
        for (const std::string& other : apart) {
            Names seen;
            EXPECT_FALSE(room != other && leads_to(room, other, seen)) << room << " -> " << other;
        }
}

TEST(Architecture, of_the_rooms_that_change_a_mesh_only_judge_writes_it) {
    static const std::regex writes(R"re(\b(remove_face|move_star|remove_vertex|mesh_?\.add_face)\(|\]\.position = )re");
    for (const char* room : {"simplify", "improve"})
        for_sources(kLibrary / room, [&](const fs::path& file) {
            std::ifstream stream(file);
            int number = 0;
            for (std::string line; std::getline(stream, line);) {
                ++number;
                EXPECT_FALSE(std::regex_search(line, writes))
                    << file.string() << ':' << number << ": propose a Change, and let Judge::apply make it";
            }
        });
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
            EXPECT_NE(room_of(include), kAll) << file.string() << " includes " << include;
    });
}

TEST(Architecture, the_library_and_the_program_under_the_gpl_share_no_code) {
    for_sources(kRoot / "apps/delaunay", [&](const fs::path& file) {
        for (const std::string& include : includes_of(file))
            EXPECT_TRUE(include.find('/') == std::string::npos && fs::exists(file.parent_path() / include))
                << file.string() << " includes " << include;
    });
    for_sources(kLibrary, [&](const fs::path& file) {
        std::ifstream stream(file);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const bool may = file == kLibrary / "base/exact_predicates.cpp";  // compiled so that the GPL part is an error
        EXPECT_TRUE(may || text.find("#include <CGAL") == std::string::npos) << file.string();
    });
}

TEST(Architecture, the_library_never_forks_without_exec) {
    for_sources(kLibrary, [&](const fs::path& file) {
        std::ifstream stream(file);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        EXPECT_EQ(text.find("fork("), std::string::npos) << file.string();
    });
}

TEST(Architecture, the_programs_that_read_for_the_library_share_little_with_it) {
    const Names kShared{"helper/serve.h", "regionmesh/sandbox.h", "formats/chunked/hdf5_handle.h",
                        "formats/dicom/dicom_frame.h"};
    for (const char* folder : {"apps/hdf5", "apps/dicom", "apps/helper"})
        for_sources(kRoot / folder, [&](const fs::path& file) {
            for (const std::string& include : includes_of(file))
                EXPECT_TRUE(include.find('/') == std::string::npos || kShared.contains(include))
                    << file.string() << " includes " << include;
        });
}

TEST(Architecture, programs_include_public_headers_and_their_own) {
    for (const char* folder : {"apps/cli", "python/src"})
        for_sources(kRoot / folder, [&](const fs::path& file) {
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
