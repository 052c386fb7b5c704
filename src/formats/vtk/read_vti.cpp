#include <fmt/format.h>

#include <utility>

#include "formats/array/flat_reader.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/text/ascii_stream.h"
#include "formats/vtk/vti_header.h"
#include "formats/vtk/vtk_blocks.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Form = VtiArray::Form;

[[noreturn]] void refuse_length(const fs::path& path, const VtiHeader& header, std::uint64_t found,
                                std::uint64_t needed) {
    fail(path, fmt::format("array '{}' has {} bytes where its extent needs {}; write the file again", header.array.name,
                           found, needed));
}

std::unique_ptr<SectionReader> open_compressed(const fs::path& path, const VtiHeader& header, VolumeInfo info,
                                               const ReadOptions& options, std::uint64_t needed) {
    check_inflated(path, header.array.end - header.array.begin, needed);
    auto blocks =
        std::make_unique<VtkBlocks>(open_stored(path, header.array), open_stored(path, header.array), header.encoding);
    const auto bytes = blocks->inflated_bytes();
    if (!bytes) fail(path, fmt::format("array '{}': {}", header.array.name, blocks->problem()));
    if (*bytes != needed) refuse_length(path, header, *bytes, needed);
    return open_stream(std::move(blocks), std::move(info),
                       {.format = {header.array.type, header.encoding.is_big_endian}}, options,
                       "give --sweep z, or write the file without compression and with raw appended data");
}

/// The word in front of an array that is not compressed: its length in bytes.
void check_word(const fs::path& path, const VtiHeader& header, std::uint64_t needed) {
    std::array<std::byte, 8> bytes{};
    const auto stream = open_stored(path, header.array);
    const std::size_t size = header.encoding.word_bytes;
    if (stream->read(std::span(bytes).first(size)) < size)
        fail(path, fmt::format("array '{}': {}", header.array.name, stream->problem()));
    const std::uint64_t word = decode_word(std::span(bytes).first(size), header.encoding.is_big_endian);
    if (word != needed) refuse_length(path, header, word, needed);
}

}  // namespace

std::unique_ptr<SectionReader> open_vti(const fs::path& path, const ReadOptions& options) {
    InputFile file(path);
    const VtiHeader header = read_vti_header(file);
    const VtiArray& array = header.array;
    const SampleFormat format{array.type, header.encoding.is_big_endian};
    VolumeInfo info = volume_info(path, "vti", array.type, header.lattice.size);
    info.lattice = header.lattice;
    info.names = names_beside(path);
    const std::uint64_t needed = volume_bytes(path, info.lattice.size, sample_bytes(array.type));
    const std::uint64_t letters = array.end - array.begin;
    if (array.form == Form::kAscii) {
        if (most_ascii_samples(letters) < needed / sample_bytes(array.type))
            fail(path, fmt::format("array '{}' has fewer numbers than its extent needs", array.name));
        return open_stream(std::make_unique<AsciiStream>(std::move(file), array.begin, array.end), std::move(info),
                           {.format = kAsciiFormat}, options);
    }
    if (header.encoding.is_compressed) return open_compressed(path, header, std::move(info), options, needed);
    check_word(path, header, needed);
    if (array.form == Form::kRaw) {
        info.can_sweep = {true, true, true};
        return open_flat(std::move(file), std::move(info),
                         {.offset = array.begin + header.encoding.word_bytes, .format = format}, options);
    }
    if (needed > letters / 4 * 3 + 3) refuse_length(path, header, letters / 4 * 3, needed);
    return open_stream(open_stored(path, array), std::move(info),
                       {.offset = header.encoding.word_bytes, .format = format}, options,
                       "give --sweep z, or write the file with raw appended data");
}

}  // namespace regionmesh::formats
