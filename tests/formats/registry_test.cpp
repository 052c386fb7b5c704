#include "formats/registry.h"

#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "cli/program.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using testing::HasSubstr;
using Words = std::set<std::string>;
using RegistryInHelp = Program;

Words words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

std::string text_of_docs() {
    std::ifstream stream(test::source_folder() + "/docs/reference/files.md");
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The extensions in the first column of the table that follows a heading.
Words table_of_docs(const std::string& heading) {
    const std::string text = text_of_docs();
    std::istringstream lines(text.substr(std::min(text.find("\n## " + heading + "\n"), text.size())));
    static const std::regex extension("`(\\.[a-z0-9.]+)`");
    Words words;
    bool is_in_table = false;
    for (std::string line; std::getline(lines, line);) {
        if (is_in_table && !line.starts_with('|')) break;
        is_in_table = line.starts_with('|');
        if (!is_in_table) continue;
        const std::string column = line.substr(1, line.find('|', 1) - 1);
        for (std::sregex_iterator at(column.begin(), column.end(), extension), end; at != end; ++at)
            words.insert((*at)[1]);
    }
    return words;
}

bool is_all_built() {
    return std::ranges::all_of(all_formats(), [](const Format& format) { return format.part.is_built; });
}

TEST(Registry, every_extension_has_one_row_and_is_found_in_any_case) {
    Words seen;
    for (const Format& format : all_formats()) {
        for (const char* extension : format.extensions) {
            if (!extension) continue;
            EXPECT_TRUE(seen.insert(extension).second) << extension;
            EXPECT_EQ(find_format(std::string("a.b") + extension), &format) << extension;
        }
    }
    EXPECT_EQ(find_format("A.NII.GZ"), find_format("a.nii"));
    EXPECT_EQ(find_format("a.npy.gz"), nullptr);
    EXPECT_EQ(find_format("npy"), nullptr);
}

TEST(Registry, a_row_without_functions_says_what_to_do_or_is_an_image) {
    for (const Format& format : all_formats()) {
        const bool does_something =
            format.open_sections || format.open_tetrahedra || format.read_surface || format.write_surface;
        EXPECT_TRUE(does_something || format.refusal || format.is_image || !format.part.is_built) << format.name;
    }
}

TEST(Registry, tables_in_the_documentation_have_the_same_extensions) {
    if (!is_all_built()) GTEST_SKIP() << "the build leaves out formats";
    EXPECT_EQ(table_of_docs("Volumes, read"), words_of(volume_extensions()));
    Words meshes, tables, written = words_of(writable_extensions());
    for (const Format& format : all_formats()) {
        for (const char* extension : format.extensions)
            if (extension && format.open_tetrahedra) (format.is_table ? tables : meshes).insert(extension);
        if (format.companion) written.insert(format.companion);
    }
    EXPECT_EQ(table_of_docs("Meshes of tetrahedra"), meshes);
    EXPECT_EQ(table_of_docs("Models, written"), written);
    EXPECT_EQ(table_of_docs("Models, read"), words_of(readable_extensions()));
    for (const std::string& extension : tables) EXPECT_THAT(text_of_docs(), HasSubstr('`' + extension + '`'));
}

TEST_F(RegistryInHelp, help_names_every_extension) {
    const std::string in = run("reconstruct --help").out, convert = run("convert --help").out;
    for (const std::string& extension : words_of(volume_extensions() + " " + tetrahedron_extensions()))
        EXPECT_THAT(in, HasSubstr(extension));
    for (const std::string& extension : words_of(writable_extensions() + " " + readable_extensions()))
        EXPECT_THAT(convert, HasSubstr(extension));
}

TEST(Registry, a_format_of_a_part_that_is_not_built_is_refused_by_name) {
    const Format format{.name = "HDF5", .part = {"HDF5", false}};
    try {
        require_readable("a.h5", &format);
        ADD_FAILURE() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        EXPECT_STREQ(error.what(), "a.h5: this build reads no HDF5; build with REGIONMESH_WITH_HDF5");
    }
}

/// Says the same of the parts that this build leaves out, if any.
TEST_F(RegistryInHelp, files_of_parts_that_are_not_built_are_refused_by_name) {
    for (const Format& format : all_formats()) {
        if (format.part.is_built) continue;
        const auto file = path(std::string("a") + format.extensions[0]);
        put_text(file, "x");
        expect_refusal("info " + file.string(), 1, std::string("; build with REGIONMESH_WITH_") + format.part.option);
    }
}

}  // namespace
}  // namespace regionmesh::formats
