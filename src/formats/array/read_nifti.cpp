#include <utility>
#include <vector>

#include "formats/array/flat_reader.h"
#include "formats/array/nifti_header.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/deflate_stream.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

VolumeInfo nifti_info(const std::filesystem::path& path, const NiftiHeader& header) {
    VolumeInfo info = volume_info(path, "nifti", header.format.type, header.lattice.size);
    info.lattice = header.lattice;
    info.names = names_beside(path);
    return info;
}

std::unique_ptr<SectionReader> open_gzipped(InputFile file, const ReadOptions& options) {
    const std::filesystem::path path = file.path();
    const std::uint64_t packed_bytes = file.size();
    auto stream = std::make_unique<DeflateStream>(std::move(file));
    std::vector<std::byte> bytes(kNifti2HeaderBytes);
    bytes.resize(stream->read(bytes));
    if (bytes.size() < kNifti1HeaderBytes) fail(path, stream->problem());
    const NiftiHeader header = parse_nifti_header(path, bytes);
    check_inflated(path, packed_bytes, volume_bytes(path, header.lattice.size, sample_bytes(header.format.type)));
    check_inflated(path, packed_bytes, header.data_offset);
    stream->rewind();
    return open_stream(std::move(stream), nifti_info(path, header),
                       {.offset = header.data_offset, .format = header.format}, options,
                       "give --sweep z, or decompress the file first (gunzip)");
}

}  // namespace

std::unique_ptr<SectionReader> open_nifti(const std::filesystem::path& path, const ReadOptions& options) {
    InputFile file(path);
    if (is_gzipped(file)) return open_gzipped(std::move(file), options);
    std::vector<std::byte> bytes(kNifti2HeaderBytes);
    bytes.resize(file.read(0, bytes));
    const NiftiHeader header = parse_nifti_header(path, bytes);
    VolumeInfo info = nifti_info(path, header);
    info.can_sweep = {true, true, true};
    return open_flat(std::move(file), std::move(info), {.offset = header.data_offset, .format = header.format},
                     options);
}

}  // namespace regionmesh::formats
