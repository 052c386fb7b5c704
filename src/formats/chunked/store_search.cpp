#include "formats/chunked/store_search.h"

#include <algorithm>
#include <string>

#include "formats/input_file.h"
#include "formats/text/natural_order.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Describe = std::function<StoreEntry(const fs::path&)>;

constexpr std::size_t kMaxFolders = 100000;
constexpr int kMaxDepth = 8;

struct Search {
    const Describe& describe;
    std::vector<fs::path> volumes = {};
    std::size_t folder_count = 0;
};

StoreEntry describe_safely(const Search& search, const fs::path& folder) {
    try {
        return search.describe(folder);
    } catch (const Error&) {
        return StoreEntry::kOther;
    }
}

void look_into(Search& search, const fs::path& folder, int depth) {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        std::error_code ignored;
        if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) folders.push_back(entry->path());
        if (++search.folder_count > kMaxFolders) fail(folder, "holds too many folders to look through; name an array");
    }
    std::ranges::sort(folders, [](const fs::path& a, const fs::path& b) {
        return natural_less(a.filename().string(), b.filename().string());
    });
    for (const fs::path& below : folders) {
        const StoreEntry entry = describe_safely(search, below);
        if (entry == StoreEntry::kVolume) search.volumes.push_back(below);
        if (entry == StoreEntry::kGroup && depth < kMaxDepth) look_into(search, below, depth + 1);
    }
}

}  // namespace

fs::path only_volume(const fs::path& folder, const Describe& describe) {
    constexpr std::size_t kShown = 8;
    Search search{.describe = describe};
    look_into(search, folder, 0);
    if (search.volumes.size() == 1) return search.volumes.front();
    if (search.volumes.empty())
        fail(
            folder,
            "holds no array of integers with 2 or 3 dimensions; name a folder of a Zarr or N5 store that does, or that "
            "of an array with more dimensions, with --layer N");
    std::string list;
    for (std::size_t i = 0; i < std::min(search.volumes.size(), kShown); ++i)
        list += (i ? ", " : "") + search.volumes[i].string();
    if (search.volumes.size() > kShown) list += " and " + std::to_string(search.volumes.size() - kShown) + " more";
    fail(folder, "holds several arrays; name one: " + list);
}

std::vector<fs::path> whole_paths(const fs::path& folder) {
    const auto without_end = [](const fs::path& path) { return path.has_filename() ? path : path.parent_path(); };
    std::error_code ignored;
    const fs::path written = without_end(fs::absolute(folder).lexically_normal());
    const fs::path real = without_end(fs::weakly_canonical(folder, ignored));
    if (real.empty() || real == written) return {written};
    return {written, real};
}

}  // namespace regionmesh::formats
