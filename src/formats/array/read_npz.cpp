// NumPy's archives of arrays: zip files of .npy files, stored or deflated.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "formats/array/npy_array.h"
#include "formats/array/volume_formats.h"
#include "formats/codec/numbers.h"
#include "formats/codec/zip_directory.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

std::string array_name(const ZipEntry& entry) { return entry.name.substr(0, entry.name.size() - 4); }

/// The only array.
const ZipEntry& choose(const std::filesystem::path& path, const std::vector<ZipEntry>& arrays) {
    std::string names;
    constexpr std::size_t kShown = 20;
    for (std::size_t n = 0; n < std::min(arrays.size(), kShown); ++n)
        names += (n == 0 ? "" : ", ") + shown(array_name(arrays[n]));
    if (arrays.empty()) fail(path, "holds no array; write it with numpy.savez");
    if (arrays.size() > 1)
        fail(path, "has several arrays; save the labels alone, with numpy.save; its arrays: " + names);
    return arrays.front();
}

}  // namespace

std::unique_ptr<SectionReader> open_npz(const std::filesystem::path& path, const ReadOptions& options) {
    std::vector<ZipEntry> entries = zip_entries(InputFile(path));
    std::erase_if(entries, [](const ZipEntry& entry) { return !entry.name.ends_with(".npy"); });
    const ZipEntry& entry = choose(path, entries);
    return open_npy_in(path, entry.begin, entry.is_deflated, options);
}

}  // namespace regionmesh::formats
