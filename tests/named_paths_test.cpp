// Files, folders and pages that comments and pages name exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "support/paths.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = test::source_folder();
constexpr std::array kFolders{"src",   "include", "apps",  "tests",    "docs",
                              "bench", "script",  "cmake", "examples", "python"};
const std::set<std::string> kForeign{"nifti1.h", "nifti2.h"};  // headers of the NIfTI standard

/// Files of the repository: built, downloaded and shared ones left out.
std::vector<fs::path> list_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(kRoot))
        if (entry.is_regular_file()) files.push_back(entry.path());
    for (const char* folder : kFolders)
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
            if (entry.is_regular_file()) files.push_back(entry.path());
    return files;
}

const std::vector<fs::path>& files() {
    static const std::vector<fs::path> all = list_files();
    return all;
}

bool is_page(const fs::path& file) { return file.extension() == ".md"; }
bool is_source(const fs::path& file) { return file.extension() == ".h" || file.extension() == ".cpp"; }
bool is_cmake(const fs::path& file) { return file.extension() == ".cmake" || file.filename() == "CMakeLists.txt"; }

/// The part of a line that is prose: all of a page, the comment of a source.
std::string_view prose_of(const fs::path& file, std::string_view line) {
    if (is_page(file)) return line;
    const std::size_t at = line.find(is_source(file) ? "//" : "#");
    return at == std::string_view::npos ? std::string_view() : line.substr(at + (is_source(file) ? 2 : 1));
}

/// Longest parts made of letters, digits and . _ - / only, without points and slashes at their end. Patterns with * or
/// NAME are left out.
std::vector<std::string> words_of(std::string_view prose) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-/";
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = prose.find_first_of(kLetters, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(prose.find_first_not_of(kLetters, at), prose.size());
        std::string word(prose.substr(at, end - at));
        while (!word.empty() && (word.back() == '.' || word.back() == '/')) word.pop_back();
        const bool is_pattern = (end < prose.size() && prose[end] == '*') || (at > 0 && prose[at - 1] == '*') ||
                                word.find("NAME") != std::string::npos;
        if (!is_pattern) words.push_back(word);
        at = end;
    }
    return words;
}

/// Does the word name a file of ours by its extension, or a path by its first folder?
bool names_path(const std::string& word) {
    if (word.find("//") != std::string::npos || kForeign.contains(word)) return false;  // an address of the web
    const fs::path path(word);
    if (is_page(path) || (is_source(path) && path.has_stem())) return !path.stem().string().starts_with('.');
    return path.has_parent_path() && std::ranges::find(kFolders, path.begin()->string()) != kFolders.end();
}

bool exists(const std::string& word, const fs::path& file) {
    static const std::set<std::string> names = [] {
        std::set<std::string> all;
        for (const fs::path& path : files()) all.insert(path.filename().string());
        return all;
    }();
    for (const fs::path& base : {kRoot, kRoot / "src", kRoot / "include", kRoot / "tests", file.parent_path()})
        if (fs::exists(base / word)) return true;
    return word.find('/') == std::string::npos && names.contains(word);
}

TEST(NamedPaths, in_comments_and_pages_exist) {
    int seen = 0;
    for (const fs::path& file : files()) {
        if (!is_page(file) && !is_source(file) && !is_cmake(file)) continue;
        if (file.string().starts_with((kRoot / "bench/results").string())) continue;  // records of earlier versions
        std::ifstream stream(file);
        int number = 0;
        for (std::string line; std::getline(stream, line);) {
            ++number;
            for (const std::string& word : words_of(prose_of(file, line))) {
                if (!names_path(word)) continue;
                ++seen;
                EXPECT_TRUE(exists(word, file)) << file.string() << ":" << number << ": there is no " << word;
            }
        }
    }
    EXPECT_GT(seen, 200) << "this test looks in the wrong place";
}

/// Targets of the links [text](target) of a line, without anchors.
std::vector<std::string> links_of(const std::string& line) {
    std::vector<std::string> links;
    for (std::size_t at = 0; (at = line.find("](", at)) != std::string::npos;) {
        at += 2;
        const std::string target = line.substr(at, line.find_first_of(")# ", at) - at);
        if (!target.empty() && target.find("://") == std::string::npos) links.push_back(target);
    }
    return links;
}

TEST(NamedPaths, links_of_pages_lead_somewhere) {
    int seen = 0;
    for (const fs::path& file : files()) {
        if (!is_page(file)) continue;
        std::ifstream stream(file);
        for (std::string line; std::getline(stream, line);)
            for (const std::string& link : links_of(line)) {
                ++seen;
                EXPECT_TRUE(fs::exists(file.parent_path() / link)) << file.string() << ": link to " << link;
            }
    }
    EXPECT_GT(seen, 50) << "this test looks in the wrong place";
}

TEST(NamedPaths, no_comment_cites_a_page_outside_the_repository) {
    const std::string outside = std::string("DESI") + "GN";
    for (const fs::path& file : files()) {
        if (!is_source(file)) continue;
        std::ifstream stream(file);
        for (std::string line; std::getline(stream, line);)
            EXPECT_EQ(line.find(outside), std::string::npos) << file.string() << ": " << line;
    }
}

}  // namespace
}  // namespace regionmesh
