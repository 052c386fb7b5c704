#include <fmt/format.h>

#include <utility>

#include "formats/array/flat_reader.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/text/ascii_stream.h"
#include "formats/vtk/vti_header.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {

std::unique_ptr<SectionReader> open_vti(const std::filesystem::path& path, const ReadOptions& options) {
    using Form = VtkArrayPlace::Form;
    const VtkXml xml(path, "ImageData");
    const VtiHeader header = read_vti_header(xml);
    const SampleFormat format{header.type, xml.encoding().is_big_endian};
    VolumeInfo info = volume_info(path, "vti", header.type, header.lattice.size);
    info.lattice = header.lattice;
    info.names = names_beside(path);
    const std::uint64_t needed = volume_bytes(path, info.lattice.size, sample_bytes(header.type));
    const VtkArrayPlace place = xml.place_of(header.array);
    const std::uint64_t present = place.end - place.begin;
    if (place.form == Form::kAscii) {
        if (most_ascii_samples(present) < needed / sample_bytes(header.type))
            xml.fail(header.array, "has fewer numbers than its extent needs");
        return open_stream(std::make_unique<AsciiStream>(InputFile(path), place.begin, place.end), std::move(info),
                           {.format = kAsciiFormat}, options);
    }
    const bool is_compressed = xml.encoding().is_compressed;
    if (is_compressed) check_inflated(path, present, needed);
    VtkBytes bytes = xml.open(header.array);
    const auto require_length = [&](std::uint64_t found) {
        if (found != needed)
            xml.fail(header.array,
                     fmt::format("has {} bytes where its extent needs {}; write the file again", found, needed));
    };
    require_length(bytes.count);
    if (place.form == Form::kRaw && !is_compressed) {
        info.can_sweep = {true, true, true};
        return open_flat(InputFile(path), std::move(info), {.offset = place.begin + bytes.offset, .format = format},
                         options);
    }
    const std::uint64_t most = present / 4 * 3 + 3;  // of base64
    if (!is_compressed && needed > most) require_length(most);
    return open_stream(std::move(bytes.stream), std::move(info), {.offset = bytes.offset, .format = format}, options,
                       "give --sweep z, or write the file with raw appended data and without compression");
}

}  // namespace regionmesh::formats
