#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "regionmesh/base/error.h"
#include "regionmesh/io/model_formats.h"
#include "regionmesh/io/ply_layout.h"

namespace regionmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they lie in the file");

constexpr std::size_t kLongestHeader = 1 << 24;  // names of regions stand in it

// Reads numbers packed without gaps.
class Unpacker {
public:
    Unpacker(std::ifstream& file, const std::string& name) : file_(file), name_(name), buffer_(1 << 20, '\0') {}
    template <class T>
    T take() {
        while (end_ - begin_ < sizeof(T)) fill();
        T value;
        std::memcpy(&value, buffer_.data() + begin_, sizeof(T));
        begin_ += sizeof(T);
        return value;
    }

private:
    void fill() {
        std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
        end_ -= begin_;
        begin_ = 0;
        file_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
        if (file_.gcount() <= 0) throw Error(ErrorCode::kInput, fmt::format("{}: cannot be read to its end", name_));
        end_ += static_cast<std::size_t>(file_.gcount());
    }

    std::ifstream& file_;
    const std::string& name_;
    std::string buffer_;
    std::size_t begin_ = 0, end_ = 0;
};

struct PlyHeader {
    std::uint64_t vertex_count = 0, face_count = 0;
    bool is_wide = false;
    InputLabel exterior_label = -1;
    LabelNames names;
    std::uint64_t bytes = 0;
};

// `text` is "3 name"; anything else is a comment like others.
void add_name(std::string_view text, LabelNames& names) {
    InputLabel label = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), label);
    const std::string_view rest(end, text.data() + text.size());
    if (error == std::errc{} && rest.size() > 1 && rest[0] == ' ') names[label] = rest.substr(1);
}

class PlyReader {
public:
    explicit PlyReader(const std::filesystem::path& path) : name_(path.string()), file_(path, std::ios::binary) {
        std::error_code error;
        file_bytes_ = std::filesystem::file_size(path, error);
        if (error || !file_) fail("cannot be read");
    }
    FileSurface read();

private:
    [[noreturn]] void fail(const std::string& text) const {
        throw Error(ErrorCode::kInput, fmt::format("{}: {}", name_, text));
    }
    template <class T>
    T number(std::string_view text, std::string_view what) const;
    PlyHeader read_header();
    void check_size(const PlyHeader& header) const;
    void read_points(const PlyHeader& header, Unpacker& unpacker, FileSurface& surface) const;
    void read_faces(const PlyHeader& header, Unpacker& unpacker, FileSurface& surface) const;

    std::string name_;
    std::ifstream file_;
    std::uint64_t file_bytes_ = 0;
};

template <class T>
T PlyReader::number(std::string_view text, std::string_view what) const {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        fail(fmt::format("bad {} '{}' in the header", what, text));
    return value;
}

PlyHeader PlyReader::read_header() {
    constexpr std::string_view kVertexElement = "element vertex ", kFaceElement = "element face ",
                               kExterior = "comment exterior_label ", kRegion = "comment region ";
    PlyHeader header;
    std::string words;  // the header without comments and counts, as ply_layout.h has it
    for (std::string line; header.bytes <= kLongestHeader && std::getline(file_, line);) {
        header.bytes += line.size() + 1;
        const std::string_view view = line;
        if (view == "end_header") {
            const std::string head =
                fmt::format("{}element vertex\n{}element face\n{}", kPlyMagic, kPlyVertex, kPlyFace);
            header.is_wide = words == head + std::string(kPlyWideLabels);
            if (!header.is_wide && words != head + std::string(kPlyLabels))
                fail(
                    "is not a PLY file with the properties that regionmesh writes; use .vtp for models of other "
                    "programs");
            return header;
        }
        if (view.starts_with(kVertexElement)) {
            header.vertex_count = number<std::uint64_t>(view.substr(kVertexElement.size()), "number of vertices");
            line = kVertexElement.substr(0, kVertexElement.size() - 1);
        } else if (view.starts_with(kFaceElement)) {
            header.face_count = number<std::uint64_t>(view.substr(kFaceElement.size()), "number of faces");
            line = kFaceElement.substr(0, kFaceElement.size() - 1);
        } else if (view.starts_with(kExterior)) {
            header.exterior_label = number<InputLabel>(view.substr(kExterior.size()), "exterior_label");
        } else if (view.starts_with(kRegion)) {
            add_name(view.substr(kRegion.size()), header.names);
        }
        if (!line.starts_with("comment")) words += line + '\n';
    }
    fail("is no PLY file, or its header has no end");
}

void PlyReader::check_size(const PlyHeader& header) const {
    if (header.vertex_count > kMostVertices || header.face_count > kMostFaces)
        fail(fmt::format("{} vertices and {} faces are more than a model can hold", header.vertex_count,
                         header.face_count));
    const std::uint64_t expected = header.bytes + header.vertex_count * kPlyVertexBytes +
                                   header.face_count * (header.is_wide ? kPlyWideFaceBytes : kPlyFaceBytes);
    if (file_bytes_ != expected)
        fail(fmt::format("has {} bytes where its header promises {} (faces that are no triangles, or a file cut short)",
                         file_bytes_, expected));
}

void PlyReader::read_points(const PlyHeader& header, Unpacker& unpacker, FileSurface& surface) const {
    surface.points.reserve(header.vertex_count);
    for (std::uint64_t i = 0; i < header.vertex_count; ++i) {
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            point[axis] = unpacker.take<double>();
            if (!std::isfinite(point[axis])) fail(fmt::format("vertex {} has a coordinate that is not finite", i));
        }
        unpacker.take<std::uint8_t>();
        surface.points.push_back(point);
    }
}

void PlyReader::read_faces(const PlyHeader& header, Unpacker& unpacker, FileSurface& surface) const {
    surface.faces.reserve(header.face_count);
    surface.labels.reserve(header.face_count);
    for (std::uint64_t i = 0; i < header.face_count; ++i) {
        const int corners = unpacker.take<std::uint8_t>();
        if (corners != 3) fail(fmt::format("face {} has {} corners: only triangles can be read", i, corners));
        std::array<std::uint32_t, 3> face;
        for (std::uint32_t& v : face) {
            v = unpacker.take<std::uint32_t>();
            if (v >= header.vertex_count) fail(fmt::format("face {} names vertex {} of {}", i, v, header.vertex_count));
        }
        surface.faces.push_back(face);
        std::array<InputLabel, 2> labels;
        for (InputLabel& label : labels)
            label = header.is_wide ? unpacker.take<std::int64_t>() : unpacker.take<std::int32_t>();
        surface.labels.push_back(labels);
    }
}

FileSurface PlyReader::read() {
    const PlyHeader header = read_header();
    check_size(header);
    FileSurface surface;
    surface.exterior_label = header.exterior_label;
    surface.names = header.names;
    Unpacker unpacker(file_, name_);
    read_points(header, unpacker, surface);
    read_faces(header, unpacker, surface);
    return surface;
}

}  // namespace

FileSurface read_ply(const std::filesystem::path& path) { return PlyReader(path).read(); }

}  // namespace regionmesh
