#include "blocks/join.h"

#include <fmt/format.h>

#include <cstdio>

#include "blocks/global_numbers.h"
#include "blocks/piece.h"
#include "formats/input_file.h"
#include "regionmesh/limits.h"
#include "stream/place_in_space.h"

namespace regionmesh {
namespace fs = std::filesystem;

namespace {

/// The piece that the manifest names, without a look at the checksum of what it holds.
fs::path entry_path(const Manifest& manifest, const fs::path& folder, std::uint32_t block) {
    const fs::path path = piece_path(folder, manifest.pieces[block].pass, block);
    if (!fs::exists(path))
        formats::fail(path, "is missing, and the manifest names it; remove the folder, and run again");
    return path;
}

void require_entry(const Manifest& manifest, std::uint32_t block, const PieceHeader& header, const fs::path& path) {
    const PieceEntry& entry = manifest.pieces[block];
    if (read_checksum(path) != entry.checksum || header.vertices != entry.vertices || header.faces != entry.faces)
        formats::fail(path, "is not the piece that the manifest names; remove the folder, and run again");
}

}  // namespace

void require_pieces(const Manifest& manifest, const fs::path& folder) {
    read_labels(manifest, folder);
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) read_entry(manifest, folder, block);
}

PieceLimits piece_limits(const Manifest& manifest) {
    const Lattice lattice = piece_lattice(manifest);
    const Vec3 cells{lattice.size[0] - 1.0, lattice.size[1] - 1.0, lattice.size[2] - 1.0};
    PieceLimits limits{.labels = manifest.label_count};
    for (const double margin : {-1.0, 1.0})  // in cells: sides of the volume may be rounded
        for (int axis = 0; axis < 3; ++axis) {
            const double at = lattice.origin[axis] + (margin + (margin > 0 ? cells[axis] : 0)) * lattice.spacing[axis];
            (margin < 0 ? limits.box.low : limits.box.high)[axis] = at;
        }
    return limits;
}

PieceHeader read_entry_header(const Manifest& manifest, const fs::path& folder, std::uint32_t block) {
    const fs::path path = entry_path(manifest, folder, block);
    const PieceHeader header = read_piece_header(path, piece_limits(manifest));
    require_entry(manifest, block, header, path);
    return header;
}

Piece read_entry(const Manifest& manifest, const fs::path& folder, std::uint32_t block) {
    const fs::path path = entry_path(manifest, folder, block);
    Piece piece = read_piece(path, piece_limits(manifest));
    require_entry(manifest, block, piece.header, path);
    return piece;
}

fs::path piece_path(const fs::path& folder, std::uint32_t pass, std::uint32_t block) {
    return folder / fmt::format("pass-{}-{:06}.piece", pass, block);
}

std::optional<std::uint32_t> pass_of(const std::string& name) {
    std::uint32_t pass = 0, block = 0;
    if (std::sscanf(name.c_str(), "pass-%u-%u.piece", &pass, &block) != 2) return {};
    if (piece_path({}, pass, block) != name) return {};
    return pass;
}

PieceMap piece_map(const Manifest& manifest, const fs::path& folder) {
    std::vector<Box> boxes;
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block)
        boxes.push_back(read_entry_header(manifest, folder, block).box);
    return {piece_grid(manifest), std::move(boxes)};
}

std::uint64_t count_vertices(const Manifest& manifest, const fs::path& folder) {
    GlobalNumbers numbers(manifest, folder);
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block)
        numbers.number(read_entry(manifest, folder, block), block);
    return numbers.count();
}

bool is_block_folder(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_directory(folder, ignored) && fs::is_regular_file(manifest_path(folder), ignored) &&
           read_manifest(folder).has_value();
}

MeshFile describe_block_folder(const fs::path& folder) {
    const Manifest manifest = read_complete_manifest(folder);
    MeshFile file{.mesh = {}, .labels = read_labels(manifest, folder)};
    file.names = manifest.names;
    file.colours = manifest.colours;
    file.coordinates = coordinates_of(manifest);
    file.background = manifest.background;
    return file;
}

MeshFile read_block_folder(const fs::path& folder) {
    const Manifest manifest = read_complete_manifest(folder);
    MeshFile file = describe_block_folder(folder);
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) read_entry_header(manifest, folder, block);
    require_mesh_size("the model in pieces", manifest.vertices, manifest.faces);
    file.mesh.reserve(manifest.vertices, manifest.faces);
    GlobalNumbers numbers(manifest, folder);
    for (std::uint32_t block = 0; block < manifest.pieces.size(); ++block) {
        const Piece piece = read_entry(manifest, folder, block);
        const std::vector<std::uint64_t> ids = numbers.number(piece, block);
        for (std::size_t n = 0; n < ids.size(); ++n)
            if (ids[n] == file.mesh.vertex_end())
                file.mesh.add_vertex(piece.vertices[n].position, piece.vertices[n].sides);
        const auto id = [&](std::uint32_t n) { return VertexId{static_cast<std::uint32_t>(ids[n])}; };
        for (const PieceFace& face : piece.faces)
            file.mesh.add_face(id(face.vertices[0]), id(face.vertices[1]), id(face.vertices[2]), face.labels[0],
                               face.labels[1]);
    }
    unscale_z(file.mesh, manifest.scale_z);
    place_in_space(file.mesh, manifest.lattice);
    return file;
}

}  // namespace regionmesh
