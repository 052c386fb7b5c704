// One definition for each name: two headers that give a name two values or two shapes break the program silently.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "support/paths.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// Names defined on a line at namespace scope; the code is formatted so that such a line is not indented.
std::vector<std::string> names_defined(const std::string& line) {
    static const std::regex type(
        R"re(^(?:struct|class|enum|enum class) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: :[^:].*)? \{.*)re");
    static const std::regex constant(R"re([ ,](k[A-Z]\w*)(?:\[\w*\])?(?: = |\{))re");
    std::vector<std::string> names;
    std::smatch match;
    if (std::regex_match(line, match, type)) names.push_back(match[1]);
    if (line.starts_with("inline constexpr ") || line.starts_with("inline const "))
        for (auto at = std::sregex_iterator(line.begin(), line.end(), constant); at != std::sregex_iterator(); ++at)
            names.push_back((*at)[1]);
    return names;
}

/// "file:line" of all definitions of a name outside anonymous namespaces.
using Definitions = std::map<std::string, std::vector<std::string>>;

void add_definitions(const fs::path& file, Definitions& found) {
    std::ifstream stream(file);
    std::vector<std::string> spaces;  // open at the line; the anonymous one is ""
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (line.starts_with("namespace ") && line.ends_with("{"))
            spaces.push_back(line == "namespace {" ? "" : line.substr(10, line.size() - 12) + "::");
        if (line.starts_with("}  // namespace") && !spaces.empty()) spaces.pop_back();
        if (std::ranges::find(spaces, "") != spaces.end()) continue;
        std::string space;
        for (const std::string& name : spaces) space += name;
        for (const std::string& name : names_defined(line))
            found[space + name].push_back(file.string() + ":" + std::to_string(number));
    }
}

Definitions definitions_in(const std::vector<fs::path>& folders) {
    Definitions found;
    for (const fs::path& folder : folders)
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
                add_definitions(entry.path(), found);
    return found;
}

TEST(Names, are_defined_once) {
    const fs::path root = test::source_folder();
    const Definitions found = definitions_in({root / "include", root / "src", root / "apps/cli"});
    EXPECT_GT(found.size(), 200u) << "this test looks in the wrong place";
    for (const auto& [name, places] : found) {
        std::string text;
        for (const std::string& place : places) text += "\n  " + place;
        EXPECT_EQ(places.size(), 1u) << name << " is defined in" << text;
    }
}

TEST(Names, are_found_in_every_form_of_definition) {
    const auto one = [](const std::string& name) { return std::vector{name}; };
    EXPECT_EQ(names_defined("struct Face {"), one("Face"));
    EXPECT_EQ(names_defined("class Mesh {"), one("Mesh"));
    EXPECT_EQ(names_defined("enum class VertexId : std::uint32_t {};"), one("VertexId"));
    EXPECT_EQ(names_defined("class ArraySections : public SectionReader {"), one("ArraySections"));
    EXPECT_EQ(names_defined("inline constexpr std::uint64_t kMostFaces = 1;"), one("kMostFaces"));
    EXPECT_EQ(names_defined("inline constexpr VertexId kNoVertex{0xFFFFFFFFu};"), one("kNoVertex"));
    EXPECT_EQ(names_defined("inline constexpr int kHull = 6, kSideCount = 7;"),
              (std::vector<std::string>{"kHull", "kSideCount"}));
    EXPECT_EQ(names_defined("struct KeyedIndex;"), std::vector<std::string>{});
    EXPECT_EQ(names_defined("    struct Inner {"), std::vector<std::string>{});
}

}  // namespace
}  // namespace regionmesh
