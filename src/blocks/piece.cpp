#include "blocks/piece.h"

#include <zlib.h>

#include <algorithm>
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

[[noreturn]] void refuse(const formats::InputFile& file, const std::string& text) {
    formats::fail(file.path(), text + ": the file is damaged; remove the folder, and run again");
}

std::uint64_t end_of_faces(const PieceHeader& header) {
    return sizeof(header) + header.vertices * sizeof(PieceVertex) + header.faces * sizeof(PieceFace);
}

bool is_share(double x) { return x >= 0 && x <= HUGE_VAL; }
bool is_bound(float x) { return x >= 0 && std::isfinite(x); }

/// Corners of a box that holds nothing are those of Box.
bool is_box_of(const PieceHeader& header, const PieceLimits& limits) {
    const Box &own = header.box, &whole = limits.box;
    if (own.is_empty()) return header.vertices == 0 && own.low == Box().low && own.high == Box().high;
    if (header.vertices == 0 || !is_finite(own.low) || !is_finite(own.high) || min(own.low, own.high) != own.low)
        return false;
    return whole.is_empty() || (min(own.low, whole.low) == whole.low && max(own.high, whole.high) == whole.high);
}

PieceHeader header_of(const formats::InputFile& file, const PieceLimits& limits = {}) {
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
    const int stopped = static_cast<int>(header.stopped);
    if (stopped < 0 || stopped > static_cast<int>(StopReason::kNoneAsked) || !is_bound(header.error_bound) ||
        !std::ranges::all_of(header.left, is_share) || !is_box_of(header, limits))
        refuse(file, "its header has numbers that no piece has");
    return header;
}

void require_sound(const formats::InputFile& file, const Piece& piece, const PieceLimits& limits) {
    Box box;
    for (const PieceVertex& vertex : piece.vertices) {
        if (!is_finite(vertex.position)) refuse(file, "a vertex has a coordinate that is not finite");
        if (!is_bound(vertex.error_bound) || vertex.error_bound > piece.header.error_bound || vertex.is_shared > 1 ||
            (vertex.sides & ~(kBoxSides | kPinned)))
            refuse(file, "a vertex has what no vertex has");
        box.add(vertex.position);
    }
    if (box.low != piece.header.box.low || box.high != piece.header.box.high)
        refuse(file, "the vertices lie in another box than its header says");
    for (const PieceFace& face : piece.faces) {
        const auto& [a, b, c] = face.vertices;
        if (std::max({a, b, c}) >= piece.vertices.size()) refuse(file, "a face has a vertex that is not there");
        if (a == b || b == c || c == a || face.labels[0] == face.labels[1])
            refuse(file, "a face has one vertex or one label twice");
        for (const Label label : face.labels)
            if (label >= limits.labels && !(is_exterior(label) && side_of(label) < kHull))
                refuse(file, "a face has a label that the folder does not have");
    }
}

/// Each collapse has two vertices that are there and belong to this piece alone; levels rise.
void require_log(const formats::InputFile& file, const Piece& piece) {
    std::vector<bool> is_gone(piece.vertices.size());
    double level = -HUGE_VAL;
    for (const LoggedCollapse& collapse : piece.log) {
        const std::uint32_t goes = collapse.goes, stays = collapse.stays;
        if (std::max(goes, stays) >= is_gone.size() || goes == stays || is_gone[goes] || is_gone[stays] ||
            piece.vertices[goes].is_shared || piece.vertices[stays].is_shared)
            refuse(file, "a collapse has a vertex that is not there, or belongs to other pieces");
        if (!is_finite(collapse.position) || !is_bound(collapse.goes_bound) || !is_bound(collapse.stays_bound) ||
            !(collapse.level >= level))
            refuse(file, "a collapse has a number that no collapse has");
        is_gone[goes] = true;
        level = collapse.level;
    }
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

Piece read_piece(const fs::path& path, const PieceLimits& limits) {
    const formats::InputFile file(path);
    Piece piece{header_of(file, limits), {}, {}, {}};
    piece.vertices.resize(piece.header.vertices);
    piece.faces.resize(piece.header.faces);
    std::uint64_t at = read_items(file, sizeof(PieceHeader), std::span(piece.vertices));
    read_items(file, at, std::span(piece.faces));
    piece.log = log_of(file, piece.header);
    std::uint32_t checksum = 0;
    for (const std::string_view bytes : parts_of(piece)) checksum = add_to(checksum, bytes);
    if (checksum != checksum_in(file))
        formats::fail(path, "the checksum does not fit: the file is damaged; remove the folder, and run again");
    require_sound(file, piece, limits);
    require_log(file, piece);
    return piece;
}

std::vector<LoggedCollapse> read_piece_log(const fs::path& path) {
    const formats::InputFile file(path);
    return log_of(file, header_of(file));
}

PieceHeader read_piece_header(const fs::path& path, const PieceLimits& limits) {
    return header_of(formats::InputFile(path), limits);
}

std::uint32_t read_checksum(const fs::path& path) { return checksum_in(formats::InputFile(path)); }

std::optional<std::uint32_t> find_piece(const fs::path& path, const PieceHeader& like, const PieceLimits& limits) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return {};
    try {
        const PieceHeader header = read_piece(path, limits).header;
        if (header.job != like.job || header.pass != like.pass || header.block != like.block) return {};
    } catch (const Error&) {
        return {};  // made again
    }
    return read_checksum(path);
}

}  // namespace regionmesh
