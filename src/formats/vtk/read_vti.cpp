// VTK image data: the samples of points, or of cells.
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/array/affine.h"
#include "formats/array/flat_reader.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/sample_format.h"
#include "formats/text/ascii_stream.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_xml.h"
#include "regionmesh/label_names_file.h"
#include "regionmesh/lattice.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {
namespace {

struct VtiHeader {
    Lattice lattice;  // of the samples: points, or centres of cells
    pugi::xml_node array;
    SampleFormat format;
};

/// The array called `wanted`; where that is empty, the active scalars, or else the only array of integers, or of reals.
pugi::xml_node choose_array(const VtkXml& xml, pugi::xml_node piece, const std::string& wanted) {
    const std::vector<pugi::xml_node> all = arrays_of(piece, false);
    std::vector<MeshArray> arrays;
    for (const pugi::xml_node node : all) arrays.push_back(describe(node));
    for (std::size_t i = 0; i < all.size() && !wanted.empty(); ++i)
        if (arrays[i].name == wanted && arrays[i].components == 1) return all[i];
    if (!wanted.empty())
        xml.fail(fmt::format("has no array '{}' of single numbers; its arrays: {}", shown(wanted), list_of(arrays)));
    std::size_t integers = 0;
    for (const bool is_integer : {true, false}) {
        for (const bool is_active_only : {true, false}) {
            pugi::xml_node chosen;
            std::size_t count = 0;
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (arrays[i].is_integer != is_integer || arrays[i].components != 1) continue;
                if (is_active_only && all[i].parent().attribute("Scalars").value() != arrays[i].name) continue;
                chosen = all[i];
                ++count;
            }
            if (count == 1) return chosen;
            if (is_integer) integers = count;
        }
        if (integers > 0) break;
    }
    xml.fail(fmt::format("has {}; its arrays: {}",
                         integers == 0 ? "no array of single numbers that could be labels, or several of reals; "
                                         "write a file with the labels only"
                                       : "several arrays of integers; choose one with --array NAME",
                         list_of(arrays)));
}

/// Samples of cells lie at the cell centres, one fewer per axis; an axis of one point has one cell at that point.
void place_in_space(const VtkXml& xml, pugi::xml_node piece, bool is_cell, const ReadOptions& options,
                    Lattice& lattice) {
    const auto numbers = [&](const char* name, std::size_t count, std::vector<double> otherwise) {
        const std::string_view text = xml.dataset().attribute(name).value();
        if (text.empty() && !otherwise.empty()) return otherwise;
        auto found = parse_reals(text);
        if (!found || found->size() != count)
            xml.fail(fmt::format("{} is '{}': {} numbers are needed", name, shown(text), count));
        return *found;
    };
    const auto origin = numbers("Origin", 3, {0, 0, 0}), spacing = numbers("Spacing", 3, {1, 1, 1});
    const auto direction = numbers("Direction", 9, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    const std::string_view text = piece.attribute("Extent").value();
    std::vector<std::int64_t> extent;
    for (const std::string_view word : split_words(text))
        if (const auto number = parse_integer(word)) extent.push_back(*number);
    Columns columns;
    Vec3 steps;  // to the first sample
    std::array<std::uint64_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::int64_t kMost = std::int64_t{1} << 40;
        if (extent.size() != 6 || extent[2 * axis] < -kMost || extent[2 * axis + 1] > kMost ||
            extent[2 * axis + 1] < extent[2 * axis])
            xml.fail(fmt::format("Extent is '{}': first and last index on each axis are needed", shown(text)));
        const std::int64_t low = extent[2 * axis], parts = extent[2 * axis + 1] - low;
        const bool is_between = is_cell && parts > 0;
        size[axis] = static_cast<std::uint64_t>(is_between ? parts : parts + 1);
        columns[axis] = spacing[axis] * Vec3{direction[axis], direction[3 + axis], direction[6 + axis]};
        steps[static_cast<int>(axis)] = static_cast<double>(low) + (is_between ? 0.5 : 0);
    }
    lattice.size = checked_size(xml.path(), size);
    const Vec3 first = first_sample(columns, {origin[0], origin[1], origin[2]}, steps, options);
    set_affine(xml.path(), "map to space", "mend Origin, Spacing or Direction", columns, first, lattice);
}

/// Throws Error(kInput) naming the file: more than one piece, no array that could be labels, or several of which none
/// is the active scalars.
VtiHeader read_vti_header(const VtkXml& xml, const std::string& array, const ReadOptions& options) {
    const pugi::xml_node piece = xml.dataset().child("Piece");
    if (!piece || piece.next_sibling("Piece")) xml.fail("has no Piece, or several; write it as one piece");
    VtiHeader header;
    header.array = choose_array(xml, piece, array);
    const NumberType type = *vtk_type(header.array);
    if (is_real(type))
        header.format = real_format(type, xml.encoding().is_big_endian);
    else
        header.format = {sample_type(type), xml.encoding().is_big_endian};
    place_in_space(xml, piece, describe(header.array).is_cell, options, header.lattice);
    return header;
}

}  // namespace

std::unique_ptr<SectionReader> open_vti(const std::filesystem::path& named, const ReadOptions& options) {
    using Form = VtkArrayPlace::Form;
    const auto [path, dataset] = split_dataset(named);
    const VtkXml xml(path, "ImageData");
    const VtiHeader header = read_vti_header(xml, dataset.empty() ? "" : dataset.substr(1), options);
    const SampleFormat& format = header.format;
    const std::uint64_t sample = sample_bytes(format);
    VolumeInfo info = volume_info(path, "vti", format.type, header.lattice.size);
    info.lattice = header.lattice;
    NamesAndColours table = table_beside(path);
    info.names = std::move(table.names);
    info.colours = std::move(table.colours);
    info.warning = std::move(table.warning);
    const std::uint64_t needed = volume_bytes(path, info.lattice.size, sample);
    const VtkArrayPlace place = xml.place_of(header.array);
    const std::uint64_t present = place.end - place.begin;
    if (place.form == Form::kAscii) {
        const std::uint64_t count = needed / sample;
        if (most_ascii_samples(present) < count)
            xml.fail(header.array, "has fewer numbers than its extent needs; write the file again");
        return open_stream(std::make_unique<AsciiStream>(InputFile(path), format, count, place.begin, place.end),
                           std::move(info), {.format = ascii_format(format)}, options);
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
