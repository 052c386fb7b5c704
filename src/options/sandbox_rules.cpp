// Rights that the process of a command keeps: read anything, write below the folders of its outputs.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "formats/find_program.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// The folder, since files get their name when they are complete; a device, a pipe or a folder is written itself.
void add_output(const fs::path& given, std::vector<fs::path>& writable) {
    std::error_code ignored;
    const fs::path path = given.has_filename() ? given : given.parent_path();  // "folder/"
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) return writable.push_back(path);
    writable.push_back(folder_of(path));
    const fs::path target = fs::weakly_canonical(path, ignored);
    if (!ignored) writable.push_back(folder_of(target));
}

}  // namespace

SandboxRules sandbox_rules(const Settings& settings) {
    SandboxRules rules{.starts_programs = true};
    for (const auto& [name, text] : settings.given)
        if (find_option(name)->is_output && !text.empty()) add_output(text, rules.writable);
    const char* temporary = std::getenv("TMPDIR");
    rules.writable.emplace_back(temporary && *temporary ? temporary : "/tmp");
    rules.runnable = formats::places_of_program(formats::kHdf5Program);
    std::ranges::move(formats::places_of_program(formats::kDicomProgram), std::back_inserter(rules.runnable));
    std::ranges::move(formats::places_of_program(formats::kDelaunayProgram, settings.tetrahedra.delaunay),
                      std::back_inserter(rules.runnable));
    return rules;
}

}  // namespace regionmesh
