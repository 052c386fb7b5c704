#include <fmt/format.h>

#include "formats/array/nrrd_header.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

std::uint32_t chosen_layer(const std::filesystem::path& path, const NrrdHeader& header, const ReadOptions& options) {
    const std::uint32_t count = header.layer_count;
    if (count == 1 && !options.layer) return 0;
    if (!options.layer) {
        const std::string kind = header.layer_kind.empty() ? "" : fmt::format(" (kind '{}')", header.layer_kind);
        fail(path, fmt::format("holds {} layers{}, each with labels of its own; give --layer 0 to --layer {}", count,
                               kind, count - 1));
    }
    if (*options.layer >= count)
        fail(path, fmt::format("has layers 0 to {}; --layer {} is none of them", count - 1, *options.layer));
    return *options.layer;
}

}  // namespace

std::unique_ptr<SectionReader> open_nrrd(const std::filesystem::path& path, const ReadOptions& options) {
    NrrdHeader header = read_nrrd_header(InputFile(path));
    const std::uint32_t layer = chosen_layer(path, header, options);
    StoredSamples& samples = header.samples;
    (header.has_layers_first ? samples.components : samples.blocks) = header.layer_count;
    (header.has_layers_first ? samples.component : samples.block) = layer;
    VolumeInfo info = volume_info(path, "nrrd", samples.format.type, header.lattice.size);
    info.lattice = header.lattice;
    const auto names = header.names.find(layer);
    info.names = names == header.names.end() ? names_beside(path) : names->second;
    ReadOptions rest = options;
    rest.layer.reset();
    return open_samples(samples, std::move(info), rest);
}

}  // namespace regionmesh::formats
