#include "formats/array/array_file.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {

std::unique_ptr<SectionReader> open_raw(const std::filesystem::path& path, const ReadOptions& options) {
    const InputFile file(path);
    if (!options.raw_size || !options.raw_type) {
        fail(path,
             "raw samples do not say what they are; give --size X,Y,Z and --type uint8 (or another integer type)");
    }
    const auto [x, y, z] = *options.raw_size;
    ArrayFile array{.format = "raw", .source = path, .sample = {.type = *options.raw_type}};
    array.lattice.size = checked_size(path, {x, y, z});
    const std::uint64_t needed = volume_bytes(path, array.lattice.size, sample_bytes(*options.raw_type));
    if (file.size() != needed) {
        fail(path, "the file has " + std::to_string(file.size()) + " bytes where " + size_text({x, y, z}) +
                       " samples of " + to_string(*options.raw_type) + " take " + std::to_string(needed) +
                       "; check --size and --type");
    }
    return open_array(array, options);
}

}  // namespace regionmesh::formats
