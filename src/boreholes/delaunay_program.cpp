#include "boreholes/delaunay_program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "regionmesh-delaunay";
constexpr const char* kVariable = "REGIONMESH_DELAUNAY";

bool is_program(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

fs::path demand(const fs::path& path, const std::string& giver) {
    if (is_program(path)) return path;
    throw Error(ErrorCode::kInput,
                path.string() + ": is no program that can be run; " + giver + " gives it as " + kName);
}

/// Empty where the system does not report it.
fs::path folder_of_this_program() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

/// Empty where PATH has no such program.
fs::path find_on_path() {
    const char* variable = std::getenv("PATH");
    std::string_view folders = variable == nullptr ? "" : variable;
    while (!folders.empty()) {
        const std::string_view folder = folders.substr(0, folders.find(':'));
        folders.remove_prefix(std::min(folder.size() + 1, folders.size()));
        if (!folder.empty() && is_program(fs::path(folder) / kName)) return fs::path(folder) / kName;
    }
    return {};
}

}  // namespace

fs::path find_delaunay(const fs::path& given) {
    if (!given.empty()) return demand(given, "the option");
    const char* variable = std::getenv(kVariable);
    if (variable != nullptr && *variable != '\0') return demand(variable, kVariable);
    const fs::path here = folder_of_this_program();
    if (!here.empty() && is_program(here / kName)) return here / kName;
    if (const fs::path found = find_on_path(); !found.empty()) return found;
    throw Error(ErrorCode::kInput, std::string(kName) + ": not found beside " +
                                       (here.empty() ? "this program" : here.string()) + " or on PATH; set " +
                                       kVariable);
}

}  // namespace regionmesh::formats
