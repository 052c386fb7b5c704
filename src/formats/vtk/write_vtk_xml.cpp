// VTK PolyData and UnstructuredGrid in XML: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/parallel_for.h"
#include "formats/codec/base64.h"
#include "formats/surface/mesh_formats.h"
#include "regionmesh/output_file.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the file says LittleEndian and numbers are written as they lie in memory");

constexpr std::size_t kBlockBytes = 1 << 20;  // uncompressed; a multiple of the size of every number
constexpr std::uint32_t kMostBlocks = 4;      // compressed at a time
constexpr std::size_t kProbeBytes = 1 << 15;
constexpr int kStored = 0, kFast = 1;  // levels of libdeflate

template <class T>
constexpr const char* vtk_type() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::uint64_t>) return "UInt64";
    if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
    if constexpr (std::is_same_v<T, std::int8_t>) return "Int8";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

// Makes streams of zlib.
class Compressor {
public:
    explicit Compressor(int level) : made_(libdeflate_alloc_compressor(level), libdeflate_free_compressor) {
        if (!made_) throw std::bad_alloc();
    }
    static std::size_t bound(std::size_t bytes) { return libdeflate_zlib_compress_bound(nullptr, bytes); }
    // Returns the size. Requires room for bound(plain.size()) bytes.
    std::size_t pack(std::span<const std::byte> plain, std::span<std::byte> packed) {
        return libdeflate_zlib_compress(made_.get(), plain.data(), plain.size(), packed.data(), packed.size());
    }

private:
    std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> made_;
};

// What one thread compresses at a time.
struct Block {
    std::vector<std::byte> plain = std::vector<std::byte>(kBlockBytes);
    std::size_t used = 0;
    std::vector<std::byte> packed = std::vector<std::byte>(Compressor::bound(kBlockBytes));
    std::size_t packed_size = 0;
    Compressor fast = Compressor(kFast), stored = Compressor(kStored);

    // Smoothed positions hardly compress, which would take most of the time to save a tenth of their size. A block
    // whose beginning shrinks by less than an eighth is stored.
    void pack() {
        const std::span own = std::span<const std::byte>(plain).first(used);
        const std::size_t probe = std::min(kProbeBytes, used);
        const bool is_stored = fast.pack(own.first(probe), packed) > probe / 8 * 7;
        packed_size = (is_stored ? stored : fast).pack(own, packed);
    }
};

// A file and the blocks in which its arrays are compressed. Arrays are written one after the other and share the
// blocks.
struct ArrayFile {
    OutputFile& file;
    std::vector<Block> blocks = {};
};

// One DataArray: collects numbers into blocks, compresses some blocks at a time on several threads and writes them in
// their order. The header with the compressed sizes precedes the blocks but is known only after them, so its place is
// filled in last.
template <class T>
class ArrayWriter {
public:
    ArrayWriter(ArrayFile& file, std::string_view name, int components, std::uint64_t count, const char* attribute = "")
        : file_(file.file), blocks_(file.blocks) {
        file_.write(fmt::format("<DataArray type=\"{}\"{} Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n",
                                vtk_type<T>(), attribute, name, components));
        const std::uint64_t bytes = count * sizeof(T);
        header_ = {(bytes + kBlockBytes - 1) / kBlockBytes, kBlockBytes, bytes % kBlockBytes};
        block_count_ = header_[0];
        header_offset_ = file_.size();
        file_.write(std::string(base64_length((header_.size() + block_count_) * sizeof(std::uint64_t)), 'A'));
        const std::uint32_t threads = file_.options().threads;
        const std::uint32_t at_a_time = threads == 0 ? kMostBlocks : std::min(threads, kMostBlocks);
        most_full_ = std::clamp<std::uint64_t>(block_count_, 1, at_a_time);
        if (blocks_.size() < most_full_) blocks_.resize(most_full_);
    }

    void put(T value) {
        if (blocks_[full_].used == kBlockBytes && ++full_ == most_full_) write_blocks();
        Block& block = blocks_[full_];
        std::memcpy(&block.plain[block.used], &value, sizeof(T));
        block.used += sizeof(T);
    }

    void close() {
        if (blocks_[full_].used > 0) ++full_;
        write_blocks();
        assert(header_.size() == 3 + block_count_);
        text_.clear();
        encoder_.finish(text_);
        file_.write(text_);
        file_.overwrite(header_offset_, base64(std::as_bytes(std::span(header_))));
        file_.write("\n</DataArray>\n");
    }

private:
    void write_blocks() {
        parallel_for(static_cast<std::uint32_t>(full_), file_.options().threads,
                     [&](std::uint32_t n) { blocks_[n].pack(); });
        for (Block& block : std::span(blocks_).first(full_)) {
            header_.push_back(block.packed_size);
            text_.clear();
            encoder_.encode(std::span(block.packed).first(block.packed_size), text_);
            file_.write(text_);
            block.used = 0;
        }
        full_ = 0;
    }

    OutputFile& file_;
    Base64Encoder encoder_;
    std::vector<std::uint64_t> header_;  // number of blocks, their size, size of the last if smaller, compressed sizes
    std::uint64_t block_count_ = 0;
    std::uint64_t header_offset_ = 0;
    std::vector<Block>& blocks_;  // of the file; `used` is 0 in all of them between two arrays
    std::size_t full_ = 0;        // blocks to compress
    std::size_t most_full_ = 0;   // blocks compressed at a time
    std::string text_;
};

constexpr std::uint8_t kVtkTriangle = 5;

enum class DataSet { kPolyData, kUnstructuredGrid };

/// The header and the end of an array of labels in text.
void write_label_array(const FileView& view, std::string_view name, std::size_t count, const std::string& text,
                       OutputFile& file) {
    file.write(fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</DataArray>\n",
                           vtk_label_type(view.labels()), name, count, text));
}

// Strings in ascii are the codes of their bytes, with a 0 after each string.
void write_names(const FileView& view, OutputFile& file) {
    std::string labels, codes;
    int count = 0;
    view.for_names([&](Label label, const std::string& name) {
        ++count;
        labels += view.label_text(label) + '\n';
        for (const char c : name) codes += fmt::format("{} ", static_cast<unsigned char>(c));
        codes += "0\n";
    });
    if (count == 0) return;
    write_label_array(view, "RegionLabels", count, '\n' + labels, file);
    file.write(
        fmt::format("<Array type=\"String\" Name=\"RegionNames\" NumberOfTuples=\"{}\" format=\"ascii\">\n{}</Array>\n",
                    count, codes));
}

void write_given_colours(const FileView& view, OutputFile& file) {
    std::string labels, colours;
    int count = 0;
    view.for_given_colours([&](Label label, std::uint32_t colour) {
        ++count;
        labels += view.label_text(label) + '\n';
        const auto [red, green, blue] = rgb_of(colour);
        colours += fmt::format("{} {} {}\n", red, green, blue);
    });
    if (count == 0) return;
    write_label_array(view, "ColourLabels", count, '\n' + labels, file);
    file.write(
        fmt::format("<DataArray type=\"UInt8\" Name=\"RegionColours\" NumberOfComponents=\"3\" NumberOfTuples=\"{}\" "
                    "format=\"ascii\">\n{}</DataArray>\n",
                    count, colours));
}

void write_space(Space space, OutputFile& file) {
    if (space == Space::kUnknown) return;
    std::string codes;
    for (const char* c = space_name(space); *c != 0; ++c) codes += fmt::format("{} ", static_cast<int>(*c));
    file.write(fmt::format("<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">{}0</Array>\n",
                           codes));
}

void write_lengths(const Coordinates& coordinates, OutputFile& file) {
    if (coordinates.metres)
        file.write(
            fmt::format("<DataArray type=\"Float64\" Name=\"MetresPerUnit\" NumberOfTuples=\"1\" format=\"ascii\">"
                        "{}</DataArray>\n",
                        *coordinates.metres));
    if (const auto& spacing = coordinates.spacing)
        file.write(
            fmt::format("<DataArray type=\"Float64\" Name=\"SampleSpacing\" NumberOfComponents=\"3\" "
                        "NumberOfTuples=\"1\" format=\"ascii\">{} {} {}</DataArray>\n",
                        spacing->x, spacing->y, spacing->z));
}

void write_background(const FileView& view, OutputFile& file) {
    const std::vector<InputLabel> labels = view.background_labels();
    std::string text;
    for (const InputLabel label : labels) text += view.labels().text(label) + ' ';
    write_label_array(view, "BackgroundLabels", labels.size(), text, file);
}

void write_head(const FileView& view, DataSet kind, OutputFile& file) {
    const bool is_grid = kind == DataSet::kUnstructuredGrid;
    file.write(
        fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
                    "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{0}>\n<FieldData>\n",
                    is_grid ? "UnstructuredGrid" : "PolyData"));
    if (const InputLabel exterior = view.exterior_label(); exterior != -1)
        write_label_array(view, "ExteriorLabel", 1, view.labels().text(exterior), file);
    write_background(view, file);
    write_space(view.coordinates().space, file);
    write_lengths(view.coordinates(), file);
    write_names(view, file);
    write_given_colours(view, file);
    const std::uint64_t vertices = view.mesh().vertex_count(), faces = view.mesh().face_count();
    file.write(fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" ", vertices));
    if (!is_grid) file.write("NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" ");
    file.write(fmt::format("NumberOf{}=\"{}\">\n", is_grid ? "Cells" : "Polys", faces));
}

/// What points have besides their place.
struct PointNumbers {
    std::span<const PointArray> arrays = {};
    std::span<const std::uint64_t> ids = {};  // by vertex id: the number in the whole model. May be empty
};

void write_points(const FileView& view, const PointNumbers& numbers, ArrayFile& to) {
    const std::uint64_t count = view.mesh().vertex_count();
    to.file.write(numbers.ids.empty() ? "<PointData>\n" : "<PointData GlobalIds=\"GlobalIds\">\n");
    if (!numbers.ids.empty()) {
        // Without IdType VTK does not take the array for global ids.
        ArrayWriter<std::int64_t> ids(to, "GlobalIds", 1, count, " IdType=\"1\"");
        view.for_vertices([&](VertexId v) { ids.put(static_cast<std::int64_t>(numbers.ids[index(v)])); });
        ids.close();
    }
    ArrayWriter<std::int8_t> types(to, "NodeType", 1, count);
    view.for_vertices([&](VertexId v) { types.put(static_cast<std::int8_t>(view.node_type(v))); });
    types.close();
    for (const PointArray& array : numbers.arrays) {
        ArrayWriter<double> values(to, array.name, 1, count);
        view.for_vertices([&](VertexId v) { values.put(array.values[index(v)]); });
        values.close();
    }
    to.file.write("</PointData>\n<Points>\n");
    ArrayWriter<double> points(to, "Points", 3, 3 * count);
    view.for_vertices([&](VertexId v) {
        const Vec3 position = view.mesh().position(v);
        for (int axis = 0; axis < 3; ++axis) points.put(position[axis]);
    });
    points.close();
    to.file.write("</Points>\n");
}

// `Number`: a signed or an unsigned integer of 64 bits.
template <class Number>
void write_labels(const FileView& view, ArrayFile& to) {
    to.file.write("<CellData Scalars=\"Region\">\n");
    for (const int side : {0, 1}) {
        ArrayWriter<Number> region(to, side == 0 ? "Region" : "Neighbour", 1, view.mesh().face_count());
        view.for_faces([&](FaceId f) { region.put(static_cast<Number>(view.face(f).labels[side])); });
        region.close();
    }
    ArrayWriter<Number> labels(to, "BoundaryLabels", 2, std::uint64_t{2} * view.mesh().face_count());
    view.for_faces([&](FaceId f) {
        for (const InputLabel label : view.face(f).labels) labels.put(static_cast<Number>(label));
    });
    labels.close();
    const FaceColours colours(view);
    ArrayWriter<std::uint8_t> rgb(to, "RGB", 3, std::uint64_t{3} * view.mesh().face_count());
    view.for_faces([&](FaceId f) {
        for (const std::uint8_t part : colours(f)) rgb.put(part);
    });
    rgb.close();
    to.file.write("</CellData>\n");
}

// Requires an `Index` that can represent the largest vertex number and three times the number of faces.
template <class Index>
void write_faces(const FileView& view, DataSet kind, ArrayFile& to) {
    const std::uint64_t count = view.mesh().face_count();
    const bool is_grid = kind == DataSet::kUnstructuredGrid;
    to.file.write(is_grid ? "<Cells>\n" : "<Polys>\n");
    ArrayWriter<Index> connectivity(to, "connectivity", 1, 3 * count);
    view.for_faces([&](FaceId f) {
        for (const std::uint32_t v : view.face(f).vertices) connectivity.put(static_cast<Index>(v));
    });
    connectivity.close();
    ArrayWriter<Index> offsets(to, "offsets", 1, count);
    for (std::uint64_t i = 1; i <= count; ++i) offsets.put(static_cast<Index>(3 * i));
    offsets.close();
    if (is_grid) {
        ArrayWriter<std::uint8_t> types(to, "types", 1, count);
        for (std::uint64_t i = 0; i < count; ++i) types.put(kVtkTriangle);
        types.close();
    }
    to.file.write(is_grid ? "</Cells>\n" : "</Polys>\n");
}

void write_vtk_xml(const FileView& view, DataSet kind, const PointNumbers& numbers, OutputFile& file) {
    write_head(view, kind, file);
    ArrayFile arrays{file};
    write_points(view, numbers, arrays);
    if (view.labels().has_large())
        write_labels<std::uint64_t>(view, arrays);
    else
        write_labels<std::int64_t>(view, arrays);
    constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
    if (std::uint64_t{3} * view.mesh().face_count() <= kMost && view.mesh().vertex_count() <= kMost)
        write_faces<std::int32_t>(view, kind, arrays);
    else
        write_faces<std::int64_t>(view, kind, arrays);
    file.write(kind == DataSet::kUnstructuredGrid ? "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
                                                  : "</Piece>\n</PolyData>\n</VTKFile>\n");
}

}  // namespace

const char* vtk_label_type(const LabelTable& labels) { return labels.has_large() ? "UInt64" : "Int64"; }

void write_vtp(const FileView& view, const std::vector<PointArray>& arrays, OutputFile& file) {
    write_vtk_xml(view, DataSet::kPolyData, {.arrays = arrays}, file);
}

void write_vtp_part(const FileView& view, std::span<const std::uint64_t> ids, OutputFile& file) {
    write_vtk_xml(view, DataSet::kPolyData, {.ids = ids}, file);
}

void write_vtu(const FileView& view, const std::vector<PointArray>& arrays, OutputFile& file) {
    write_vtk_xml(view, DataSet::kUnstructuredGrid, {.arrays = arrays}, file);
}

}  // namespace regionmesh
