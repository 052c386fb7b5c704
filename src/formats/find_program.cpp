#include "formats/find_program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

/// Empty where the system does not report it.
fs::path folder_of_this_program() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

/// The build's install prefix comes after the prefix in which the running program lies.
std::vector<fs::path> folders_to_search(const fs::path& here) {
    std::vector<fs::path> folders{here};
    for (const fs::path& prefix : {here.parent_path(), fs::path(REGIONMESH_INSTALL_PREFIX)}) {
        if (prefix.empty()) continue;
        folders.push_back(prefix / "bin");
        folders.push_back(prefix / "libexec/regionmesh");
    }
    const char* variable = std::getenv("PATH");
    std::string_view names = variable == nullptr ? "" : variable;
    while (!names.empty()) {
        const std::string_view folder = names.substr(0, names.find(':'));
        names.remove_prefix(std::min(folder.size() + 1, names.size()));
        folders.emplace_back(folder);
    }
    std::erase(folders, fs::path());
    return folders;
}

}  // namespace

fs::path find_program(const HelperProgram& program, const fs::path& given) {
    const char* variable = std::getenv(program.variable);
    const fs::path named = !given.empty() ? given : variable == nullptr ? "" : variable;
    if (is_program(named)) return named;
    if (!named.empty()) {
        throw Error(ErrorCode::kInput, named.string() + ": is no program that can be run; " +
                                           (given.empty() ? program.variable : "the option") + " gives it as " +
                                           program.name);
    }
    const fs::path here = folder_of_this_program();
    for (const fs::path& folder : folders_to_search(here))
        if (is_program(folder / program.name)) return folder / program.name;
    throw Error(ErrorCode::kInput,
                std::string(program.name) + ": not found beside " + (here.empty() ? "this program" : here.string()) +
                    ", in the install prefix " REGIONMESH_INSTALL_PREFIX " or on PATH; set " + program.variable);
}

std::vector<fs::path> places_of_program(const HelperProgram& program, const fs::path& given) {
    const char* variable = std::getenv(program.variable);
    std::vector<fs::path> places{given, variable == nullptr ? "" : variable};
    for (const fs::path& folder : folders_to_search(folder_of_this_program())) places.push_back(folder / program.name);
    std::erase_if(places, [](const fs::path& place) { return !is_program(place); });
    return places;
}

}  // namespace regionmesh::formats
