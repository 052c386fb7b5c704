#include "blocks/piece.h"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>

#include "formats/input_file.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little);

template <class T>
std::string_view bytes_of(std::span<const T> items) {
    return {reinterpret_cast<const char*>(items.data()), items.size_bytes()};
}

std::uint32_t add_to(std::uint32_t checksum, std::string_view bytes) {
    return static_cast<std::uint32_t>(::crc32_z(checksum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

template <class T>
std::uint64_t read_items(const formats::InputFile& file, std::uint64_t offset, std::span<T> items) {
    const auto bytes = std::as_writable_bytes(items);
    if (file.read(offset, bytes) != bytes.size())
        formats::fail(file.path(), "the piece ends early; remove the folder, and run again");
    return offset + bytes.size();
}

std::uint64_t end_of_faces(const PieceHeader& header) {
    return sizeof(header) + header.vertices * sizeof(PieceVertex) + header.faces * sizeof(PieceFace);
}

PieceHeader header_of(const formats::InputFile& file) {
    PieceHeader header;
    if (file.size() < sizeof(header)) formats::fail(file.path(), "is no piece of a model");
    read_items(file, 0, std::span(&header, 1));
    constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
    if (header.magic != PieceHeader{}.magic || header.vertices >= kMost || header.faces >= kMost)
        formats::fail(file.path(), "is no piece of a model");
    const std::uint64_t size = end_of_faces(header) + sizeof(std::uint32_t);
    if (file.size() < size || (file.size() - size) % sizeof(LoggedCollapse) != 0)
        formats::fail(file.path(), std::to_string(file.size()) + " bytes instead of " + std::to_string(size) +
                                       "; remove the folder, and run again");
    return header;
}

std::uint32_t checksum_in(const formats::InputFile& file) {
    std::uint32_t checksum = 0;
    if (file.size() < sizeof(checksum)) formats::fail(file.path(), "is no piece of a model");
    read_items(file, file.size() - sizeof(checksum), std::span(&checksum, 1));
    return checksum;
}

/// What is left of the file is its log.
std::vector<LoggedCollapse> log_of(const formats::InputFile& file, const PieceHeader& header) {
    const std::uint64_t first = end_of_faces(header);
    std::vector<LoggedCollapse> log((file.size() - first - sizeof(std::uint32_t)) / sizeof(LoggedCollapse));
    read_items(file, first, std::span(log));
    return log;
}

/// What the file holds before its checksum. Parts that are empty are left out: zlib would begin the checksum again.
std::vector<std::string_view> parts_of(const Piece& piece) {
    std::vector<std::string_view> parts{bytes_of(std::span(&piece.header, 1)), bytes_of(std::span(piece.vertices)),
                                        bytes_of(std::span(piece.faces)), bytes_of(std::span(piece.log))};
    std::erase_if(parts, [](std::string_view part) { return part.empty(); });
    return parts;
}

}  // namespace

std::uint32_t write_piece(Piece& piece, const fs::path& path, const OutputOptions& options) {
    PieceHeader& header = piece.header;
    header.vertices = piece.vertices.size();
    header.faces = piece.faces.size();
    header.box = {};
    header.error_bound = 0;
    for (const PieceVertex& vertex : piece.vertices) {
        header.box.add(vertex.position);
        header.error_bound = std::max(header.error_bound, vertex.error_bound);
    }
    OutputFile file(path, options);
    std::uint32_t checksum = 0;
    for (const std::string_view bytes : parts_of(piece)) {
        checksum = add_to(checksum, bytes);
        file.write(bytes);
    }
    file.write(bytes_of(std::span<const std::uint32_t>(&checksum, 1)));
    file.commit();
    return checksum;
}

Piece read_piece(const fs::path& path) {
    const formats::InputFile file(path);
    Piece piece{header_of(file), {}, {}, {}};
    piece.vertices.resize(piece.header.vertices);
    piece.faces.resize(piece.header.faces);
    std::uint64_t at = read_items(file, sizeof(PieceHeader), std::span(piece.vertices));
    read_items(file, at, std::span(piece.faces));
    piece.log = log_of(file, piece.header);
    std::uint32_t checksum = 0;
    for (const std::string_view bytes : parts_of(piece)) checksum = add_to(checksum, bytes);
    if (checksum != checksum_in(file))
        formats::fail(path, "the checksum does not fit: the file is damaged; remove the folder, and run again");
    for (const PieceVertex& vertex : piece.vertices)
        if (!is_finite(vertex.position)) formats::fail(path, "a vertex has a coordinate that is not finite");
    for (const PieceFace& face : piece.faces)
        for (const std::uint32_t v : face.vertices)
            if (v >= piece.vertices.size()) formats::fail(path, "a face has a vertex that is not there");
    for (const LoggedCollapse& collapse : piece.log)
        if (std::max(collapse.goes, collapse.stays) >= piece.vertices.size())
            formats::fail(path, "a collapse has a vertex that is not there");
    return piece;
}

std::vector<LoggedCollapse> read_piece_log(const fs::path& path) {
    const formats::InputFile file(path);
    return log_of(file, header_of(file));
}

PieceHeader read_piece_header(const fs::path& path) { return header_of(formats::InputFile(path)); }

std::uint32_t read_checksum(const fs::path& path) { return checksum_in(formats::InputFile(path)); }

std::optional<std::uint32_t> find_piece(const fs::path& path, const PieceHeader& like) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return {};
    try {
        const PieceHeader header = read_piece(path).header;
        if (header.job != like.job || header.pass != like.pass || header.block != like.block) return {};
    } catch (const Error&) {
        return {};  // made again
    }
    return read_checksum(path);
}

}  // namespace regionmesh
